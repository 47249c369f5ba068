//! What helps a player in a window: the last shot again, advice, lessons, another view.

use super::super::advice::Answer;
use super::{Desk, SAID};
use hapticbillard::input::{Action, HandInput, View};
use hapticbillard::menu::Order;
use std::time::Instant;

impl Desk<'_> {
    /// Says something over the picture for a while.
    pub(super) fn say(&mut self, text: String) {
        self.said = Some((text, Instant::now() + SAID));
    }

    /// Does what helps in a game; false if this is nothing of the kind.
    pub(super) fn help_by(&mut self, action: Action) -> bool {
        let Some(game) = &mut self.game else { return false };
        match action {
            Action::Traces => game.shows_traces ^= true,
            Action::FilmHold | Action::FilmSlower | Action::FilmFaster => game.film.turn(action),
            Action::NextLesson => game.tutor.iter_mut().for_each(|tutor| tutor.skip()),
            Action::Suggest => {
                let key = match game.ask_advice() {
                    Ok(()) => "advice_asked",
                    Err(why) => why.text(),
                };
                self.say(self.over.get(key));
            }
            _ => return false,
        }
        true
    }

    /// What came of what was asked, and what the game shows anew since the last picture.
    pub(super) fn look_after_aids(&mut self) {
        let Some(game) = &mut self.game else { return };
        self.lobby.see_film(game.film.has_film());
        if game.film.is_over() {
            for order in self.lobby.end_replay() {
                match order {
                    Order::Tell(input) => game.outbox.say(input),
                    Order::Replay(is_shown) => game.screen(is_shown),
                    _ => {}
                }
            }
        }
        let said = match game.take_advice() {
            Some(Answer::Here(advice)) => {
                game.outbox.say(HandInput::Hold(advice.aim));
                let speed = format!("{:.1}", advice.speed_m_s);
                let chance = format!("{:.0}", 100.0 * advice.chance);
                self.over.fill("advice", "speed", &speed).replace("{chance}", &chance)
            }
            Some(Answer::Nothing) => self.over.get("advice_nothing"),
            Some(Answer::Late) => self.over.get("advice_not_now"),
            None => match self.new_view() {
                Some(view) => self.over.get(view.name()),
                None => return,
            },
        };
        self.say(said);
    }

    /// The view, if it is another than in the last picture.
    fn new_view(&mut self) -> Option<View> {
        let view = self.game.as_mut()?.view().look.view;
        let is_new = std::mem::replace(&mut self.view, view) != view;
        is_new.then_some(view)
    }
}
