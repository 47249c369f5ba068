//! Options that the rules leave to a player: which one a computer takes, and what it calls.

use super::plan::{self, Goal, Plan, PlanKind};
use super::view::TableView2d;
use crate::events::{Call, CallKind, Calls, Choice};

/// Below this cost a pot is taken as it lies: nearly straight, and not far (see [`plan::cost`]).
const EASY_COST: f64 = 0.8;

/// What lies on the table for whoever shoots next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outlook {
    /// No pot is open, or the cue ball is gone.
    Nothing,
    /// A pot is open.
    Pot,
    /// A pot that hardly misses is open.
    EasyPot,
}

impl Outlook {
    /// Looks at the table.
    pub fn of(view: &TableView2d, goal: &Goal, throw_factor: f64) -> Self {
        let pot = view.cue_ball.and_then(|cue| plan::best_pot(view, cue, &goal.own, throw_factor));
        match pot {
            None => Outlook::Nothing,
            Some(shot) if shot.cost < EASY_COST => Outlook::EasyPot,
            Some(_) => Outlook::Pot,
        }
    }
}

/// The option that is taken; none if there is no option. Who has asked the other to play again
/// plays next time, so that no frame goes on for ever.
pub fn choose(options: &[Choice], outlook: Outlook, has_asked: bool) -> Option<Choice> {
    options.iter().copied().min_by_key(|choice| dislike(*choice, outlook, has_asked))
}

/// How little an option is liked; of two options the one that is less disliked is taken.
fn dislike(choice: Choice, outlook: Outlook, has_asked: bool) -> u8 {
    let open = outlook >= Outlook::Pot;
    match choice {
        // The 8 that fell on the break costs nothing and the table is open.
        Choice::Respot8Continue => 0,
        Choice::Respot8CueInHandKitchen => 1,
        // A break of one's own is worth more than a table that was hardly broken.
        Choice::RerackAndBreak => 2,
        Choice::Accept if outlook == Outlook::EasyPot => 3,
        Choice::CueInHandKitchen => 4,
        Choice::Shoot if open => 4,
        Choice::PassBack => 5,
        Choice::Play if open => 4,
        Choice::AskAgain if !has_asked => 5,
        Choice::RerackOpponentBreaks | Choice::Rebreak if !open => 6,
        Choice::Accept | Choice::Shoot | Choice::Play => 7,
        Choice::RerackOpponentBreaks | Choice::Rebreak | Choice::AskAgain => 8,
        Choice::PutBack if !has_asked => 6,
        // The next shot must lead away from a ball that touches.
        Choice::SpotFrozen => 6,
        Choice::PutBack => 9,
    }
}

/// What is called with a plan, as far as anything may be called.
pub fn call(plan: &Plan, calls: Calls) -> Option<Call> {
    let ball = plan.target.filter(|_| calls.ball);
    match plan.kind {
        PlanKind::Break => None,
        // Without pockets to name, the ball that is met is what is named.
        _ if ball.is_some() && !calls.pocket => ball.map(|ball| Call::Ball { ball, pocket: None }),
        PlanKind::Pot => ball.map(|ball| Call::Ball { ball, pocket: plan.pocket }),
        PlanKind::Kick | PlanKind::Desperate if calls.push_out => {
            Some(Call::Kind(CallKind::PushOut))
        }
        PlanKind::Contact | PlanKind::Kick | PlanKind::Desperate => {
            calls.safety.then_some(Call::Kind(CallKind::Safety))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(options: &[Choice], outlook: Outlook, wanted: Choice) {
        for turned in 0..options.len() {
            let mut options = options.to_vec();
            options.rotate_left(turned);
            assert_eq!(choose(&options, outlook, false), Some(wanted), "{options:?} {outlook:?}");
        }
    }

    #[test]
    fn each_choice_of_the_rule_books_is_decided_by_what_lies_on_the_table() {
        use Choice::*;
        use Outlook::*;
        for outlook in [Nothing, Pot, EasyPot] {
            check(&[Accept, RerackAndBreak, RerackOpponentBreaks], outlook, RerackAndBreak);
            check(&[Respot8Continue, Rebreak], outlook, Respot8Continue);
            check(&[Respot8CueInHandKitchen, Rebreak], outlook, Respot8CueInHandKitchen);
        }
        check(&[Accept, CueInHandKitchen], EasyPot, Accept);
        check(&[Accept, CueInHandKitchen], Pot, CueInHandKitchen);
        check(&[Accept, CueInHandKitchen], Nothing, CueInHandKitchen);
        check(&[Shoot, PassBack], Pot, Shoot);
        check(&[Shoot, PassBack], Nothing, PassBack);
        check(&[AskAgain, Play], Pot, Play);
        check(&[AskAgain, Play], Nothing, AskAgain);
        check(&[Accept, RerackOpponentBreaks], Nothing, RerackOpponentBreaks);
        check(&[Accept, RerackOpponentBreaks], Pot, Accept);
        assert_eq!(choose(&[AskAgain, Play], Nothing, true), Some(Play));
        assert_eq!(choose(&[], Nothing, false), None);
    }
}
