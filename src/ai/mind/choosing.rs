//! Options that the rules leave to a player.

use super::decision::{Decision, Deliberation, Thoughts};
use super::world::World;
use super::{Mind, Task, value};
use crate::events::{Choice, Command, Event, Source};
use crate::physics::PhysicsError;

/// Takes the option that is worth the most.
pub fn choose(mind: &Mind, task: &Task, world: &World) -> Option<Deliberation> {
    let valued = |choice: Choice| {
        // Who has asked the other to play again plays, so that no frame goes on for ever.
        let again = task.has_asked && matches!(choice, Choice::AskAgain | Choice::PutBack);
        let value = if again { -1.0 } else { worth(mind, world, choice) };
        (choice, value)
    };
    let options = world.turn.options.iter().copied().map(valued);
    let (choice, _) = first_best(options)?;
    let decision = Decision::Choose(choice);
    Some(Deliberation { decision, thoughts: Thoughts::default(), simulations: 0 })
}

/// The best option and what it is worth for whoever chooses.
pub fn best(mind: &Mind, world: &World) -> Option<(Choice, f64)> {
    let options = world.turn.options.iter().copied();
    first_best(options.map(|choice| (choice, worth(mind, world, choice))))
}

fn first_best(options: impl Iterator<Item = (Choice, f64)>) -> Option<(Choice, f64)> {
    options.fold(None, |best: Option<(Choice, f64)>, option| match best {
        Some(known) if option.1 <= known.1 => best,
        _ => Some(option),
    })
}

/// What it is worth to have a miss played again from where it was: the other failed once, and may
/// again. Where the balls lay then is not known here.
const PUT_BACK: f64 = 0.5;

/// Chance that the one who chooses wins after a choice.
fn worth(mind: &Mind, world: &World, choice: Choice) -> f64 {
    if choice == Choice::PutBack {
        return PUT_BACK;
    }
    let chooser = world.player();
    let mut referee = world.referee().clone();
    let sayings = referee.obey(Source::Ai(chooser), &Command::Choose(choice));
    let turn = sayings.iter().find_map(|saying| match saying {
        Event::Turn(turn) => Some(turn.clone()),
        _ => None,
    });
    let Some(turn) = turn else { return 0.0 };
    let commands: Vec<Command> = sayings
        .iter()
        .filter_map(|saying| match saying {
            Event::Command(command) => Some(command.clone()),
            _ => None,
        })
        .collect();
    let next: Result<World, PhysicsError> = world.changed_by(mind, &commands, referee, turn);
    // A table that cannot be imagined is worth as much as any.
    next.map_or(0.5, |next| value::seen_by(chooser, &next, value::position(mind, &next, None)))
}
