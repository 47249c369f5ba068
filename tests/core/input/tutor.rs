//! The tutorial is played to its end, by doing what it says.

use super::desk::{Desk, shipped};
use hapticbillard::events::Event;
use hapticbillard::input::{Button, HumanMode, Key, Lesson, RawInput, Tutor};
use hapticbillard::renderer::Words;
use hapticbillard::rules::Language;

/// A table with somebody who shows how to play.
struct Class {
    desk: Desk,
    tutor: Tutor,
    heard: usize,
}

impl Class {
    fn new() -> Self {
        Class { desk: Desk::new(&shipped("tutorial")), tutor: Tutor::default(), heard: 0 }
    }

    /// The tutor sees what a window sees: all events, and the player after them.
    fn see(&mut self) {
        let events: Vec<Event> = self.desk.heard();
        for event in &events[self.heard..] {
            if Tutor::topics().contains(event.topic()) {
                self.tutor.hear(event);
            }
        }
        self.heard = events.len();
        let view = self.desk.view();
        self.tutor.see(&view);
    }

    fn wait(&mut self, ticks: u64) {
        for _ in 0..ticks {
            self.desk.tick(&[]);
            self.see();
        }
    }

    fn press(&mut self, key: char) {
        self.desk.key(Key::Letter(key));
        self.wait(3);
    }

    fn strike(&mut self) {
        self.desk.stroke(0.2, 1.2, 500);
        self.wait(3);
    }

    #[track_caller]
    fn learns(&self, lesson: Lesson) {
        assert_eq!(self.tutor.lesson(), lesson);
    }
}

#[test]
fn every_lesson_is_over_when_it_was_done_and_not_before() {
    let mut class = Class::new();
    class.wait(500);
    class.learns(Lesson::Look);
    // What another lesson is about helps nothing.
    class.press('v');
    class.press('v');
    class.learns(Lesson::Look);
    class.desk.tick(&[
        RawInput::Button { button: Button::Middle, down: true },
        RawInput::Moved { right: 0.3, up: 0.0 },
        RawInput::Button { button: Button::Middle, down: false },
    ]);
    class.wait(2);
    class.learns(Lesson::Aim);
    // Turned away from all balls is not aimed.
    class.desk.turn_to(std::f64::consts::PI);
    class.wait(2);
    class.learns(Lesson::Aim);
    let to = glam::DVec2::new(0.45 + 0.45, 0.22);
    class.desk.turn_to(libm::atan2(to.y, to.x));
    class.wait(2);
    class.learns(Lesson::Strike);
    class.strike();
    class.learns(Lesson::Wait);
    for _ in 0..20 {
        class.wait(1_000);
        // A ball in hand, if it fell: put down where it is held.
        if class.desk.mode() == HumanMode::Placing {
            class.desk.button(Button::Left, true);
            class.desk.button(Button::Left, false);
        }
    }
    class.learns(Lesson::Tip);
    class.desk.hold(Key::Down, 1_200);
    class.wait(2);
    class.learns(Lesson::Spin);
    class.strike();
    class.learns(Lesson::View);
    class.press('v');
    class.press('v');
    class.learns(Lesson::Replay);
    class.tutor.saw_replay();
    class.wait(20_000);
    class.learns(Lesson::Undo);
    class.press('u');
    class.wait(20);
    class.learns(Lesson::End);
    assert_eq!(class.tutor.count(), (Lesson::ALL.len(), Lesson::ALL.len()));
    class.tutor.skip();
    class.learns(Lesson::End);
}

#[test]
fn whoever_strikes_early_goes_on_and_whoever_wants_to_skips() {
    let mut class = Class::new();
    class.wait(500);
    class.tutor.skip();
    class.learns(Lesson::Aim);
    class.strike();
    class.learns(Lesson::Wait);
    for _ in Lesson::ALL {
        class.tutor.skip();
    }
    class.learns(Lesson::End);
}

#[test]
fn every_lesson_has_words_for_hands_and_gamepads_in_both_languages() {
    for language in Language::ALL {
        let words = Words::new(language);
        for lesson in Lesson::ALL {
            for name in [lesson.name().to_string(), format!("{}_pad", lesson.name())] {
                let text = words.get(&name);
                assert!(text != name && !text.contains('{'), "{name}: {text}");
            }
        }
    }
}
