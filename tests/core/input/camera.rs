//! A camera that is led by hand: by mouse and keys, by a stylus.

use super::desk::{Desk, free_play};
use glam::{DVec2, DVec3};
use hapticbillard::haptic::Leads;
use hapticbillard::input::{
    Button, CameraHand, CameraPose, HandInput, HumanMode, Key, RawInput, StylusWord,
};

fn desk() -> Desk {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.0)]));
    desk.wait(400);
    desk
}

fn camera(desk: &Desk) -> CameraPose {
    desk.view().camera
}

fn way(camera: CameraPose) -> DVec3 {
    (camera.target - camera.eye).normalize()
}

#[test]
fn the_mouse_looks_keys_move_and_the_cue_waits() {
    let mut desk = desk();
    let (aim, behind_cue) = (desk.view().aim, camera(&desk));
    desk.key(Key::Letter('g'));
    assert!(desk.view().look.free);
    assert!(camera(&desk).eye.distance(behind_cue.eye) < 1e-12, "it begins where it was");
    desk.moved(0.2, 0.1);
    let looked = camera(&desk);
    assert_eq!(looked.eye, behind_cue.eye);
    // To the right is clockwise from above; upwards is upwards.
    let turned = way(behind_cue).truncate().angle_to(way(looked).truncate());
    assert!((turned + 0.5).abs() < 1e-9, "{turned}");
    assert!(way(behind_cue).z + 0.1 < way(looked).z);
    desk.hold(Key::Up, 1000);
    let walked = camera(&desk).eye - looked.eye;
    assert!((walked.length() - 1.2).abs() < 0.01 && walked.z == 0.0, "{walked}");
    assert!(way(looked).truncate().angle_to(walked.truncate()).abs() < 1e-6);
    // Nobody strikes meanwhile, by whatever.
    desk.button(Button::Left, true);
    desk.key(Key::Enter);
    desk.hold(Key::PageUp, 100);
    desk.button(Button::Left, false);
    assert_eq!((desk.mode(), desk.view().aim), (HumanMode::Aiming, aim));
    desk.key(Key::Letter('g'));
    desk.wait(400);
    assert!(!desk.view().look.free && camera(&desk).eye.distance(behind_cue.eye) < 1e-9);
    desk.stroke(0.2, 1.0, 125);
    assert_eq!(desk.tips(), 1);
}

#[test]
fn nobody_leads_it_out_of_the_room_or_into_the_table() {
    let mut desk = desk();
    desk.key(Key::Letter('g'));
    let bed = DVec2::new(2.54, 1.27);
    for (n, key) in [Key::Up, Key::PageDown, Key::Right, Key::Down, Key::PageDown, Key::Left]
        .into_iter()
        .cycle()
        .take(30)
        .enumerate()
    {
        desk.moved(0.37 * n as f64, 0.0);
        desk.tick(&[RawInput::Key { key, down: true }]);
        for _ in 0..2_500 {
            desk.tick(&[]);
            let eye = camera(&desk).eye;
            assert!(eye.abs().max_element() <= 4.0, "{eye}");
            let is_over = eye.truncate().abs().cmplt(0.5 * bed).all();
            assert!(!is_over || 0.1 - 1e-9 <= eye.z, "{eye}");
        }
        desk.tick(&[RawInput::Key { key, down: false }]);
    }
}

#[test]
fn a_stylus_leads_it_and_no_cue() {
    let scene = free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.0)]);
    let mut desk = Desk::with_stylus(&scene);
    desk.wait(400);
    assert_eq!((desk.leads(), desk.mode()), (Leads::Cue, HumanMode::HoldingStylus));
    desk.key(Key::Letter('g'));
    assert_eq!(desk.leads(), Leads::Camera);
    let before = camera(&desk);
    let moved = DVec3::new(0.0, 0.0, -0.02);
    let camera_hand = CameraHand { moved, pointing: DVec3::NEG_Z, front: false };
    let tips = desk.commands().len();
    for _ in 0..500 {
        let camera = Some(camera_hand);
        let direction = DVec3::X;
        desk.say(StylusWord::Held { direction, armed: false, path: None, camera });
    }
    // 15 mm beyond the threshold are 0.9 m/s.
    let walked = camera(&desk).eye - before.eye;
    assert!((walked.length() - 0.45).abs() < 1e-6, "{walked}");
    // Who wants it slower has it slower.
    let half = HandInput::StylusSpeed(0.5);
    let word = StylusWord::Held {
        direction: DVec3::X,
        armed: false,
        path: None,
        camera: Some(camera_hand),
    };
    let before = camera(&desk);
    (0..100).for_each(|_| desk.hear_beside(&[half], word.clone()));
    let walked = camera(&desk).eye.distance(before.eye);
    assert!((walked - 0.045).abs() < 1e-6, "{walked}");
    assert_eq!(desk.commands().len(), tips, "the cue moves");
    desk.key(Key::Escape);
    desk.wait(2);
    assert_eq!(desk.leads(), Leads::Pointer);
    desk.key(Key::Escape);
    desk.wait(2);
    desk.key(Key::Letter('g'));
    assert_eq!(desk.leads(), Leads::Cue);
}
