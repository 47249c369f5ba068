//! What stands still while the eye rests: pictures are the same as if all were drawn anew.

use super::{SIZE, lying, studio};
use glam::DVec3;
use hapticbillard::cue::CuePose;
use hapticbillard::events::FactSet;
use hapticbillard::input::{CameraPose, HumanView};
use hapticbillard::physics::Snapshot;
use hapticbillard::picture::{PictureSettings, Preset, Shadows, Smoothing, Stereo};
use hapticbillard::renderer::{DrawList, GhostBall, Line, Radii, Solid, StylusPose};
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;

/// A break that rolls, a cue with its shadow, lines, bodies: everything that moves.
fn lists(stage: &Stage, camera: CameraPose) -> Vec<DrawList> {
    let mut simulation = stage.simulation().unwrap();
    let view = HumanView { camera, ..HumanView::default() };
    let of = |world: &Snapshot| DrawList::new(world, &view, &Radii::default());
    let mut lists = Vec::new();
    for at_s in [0.0, 0.3, 1.1] {
        simulation.advance(at_s, FactSet::NONE, &mut Vec::new()).unwrap();
        lists.push(of(&simulation.snapshot(at_s)));
    }
    let colour = [0.9, 0.8, 0.2, 0.6];
    let mut held = lists[0].clone();
    held.cue = Some(CuePose {
        tip: DVec3::new(-0.5, 0.1, 0.05),
        velocity: DVec3::ZERO,
        direction: DVec3::new(0.9, 0.3, -0.1).normalize(),
        solid: false,
    });
    held.lines.push(Line {
        from: [-0.6, 0.0, 0.002],
        to: [0.9, 0.4, 0.002],
        half_width_m: 0.01,
        colour,
    });
    held.ghosts.push(GhostBall { position: [0.5, -0.3, 0.0286], radius_m: 0.0286, colour });
    held.solids.push(Solid::ball(DVec3::new(0.2, 0.5, 0.15), 0.05, colour));
    held.stylus =
        Some(StylusPose { tip: [-0.3, -0.4, 0.1], direction: [0.6, 0.0, -0.8], scale: 4.0 });
    lists.push(held);
    // Behind a rail and half in a pocket.
    let mut hidden = of(&Snapshot::default());
    for (place, at) in [[0.0, -0.61, 0.03], [-1.29, -0.655, -0.02]].into_iter().enumerate() {
        let ball = lying(place as u16, [0.0, 0.0, 0.0, 1.0]);
        hidden.balls.push(hapticbillard::renderer::BallInstance { position: at, ..ball });
    }
    lists.push(hidden);
    lists
}

#[test]
fn a_resting_eye_sees_what_a_new_one_sees() {
    let stage = Stage::new(&load_scene("break_shot").unwrap(), "break_shot").unwrap();
    let poses = [
        CameraPose::default(),
        // Low beside a rail, so that much is hidden.
        CameraPose {
            eye: DVec3::new(-0.3, -1.2, 0.12),
            target: DVec3::new(0.1, 0.0, 0.0),
            ..CameraPose::default()
        },
    ];
    let plain = PictureSettings { smooth: Smoothing::Off, ..PictureSettings::default() };
    let kinds = [
        Preset::VeryLow.applied(plain),
        Preset::Low.applied(plain),
        PictureSettings { smooth: Smoothing::Off, ..Preset::High.applied(plain) },
        PictureSettings { shadows: Shadows::Maps, ..plain },
        PictureSettings { stereo: Stereo::Middle, ..plain },
        PictureSettings { smooth: Smoothing::On, ..plain },
    ];
    let Some(mut studio) = studio(&stage.table) else { return };
    for pose in poses {
        let lists = lists(&stage, pose);
        for settings in kinds {
            let mut draw = |list: &DrawList| studio.pixels(list, &settings, SIZE).unwrap();
            let anew = |list: &DrawList| {
                // Two pictures from elsewhere: it does not rest.
                for aside in [0.1, 0.2] {
                    let mut other = list.clone();
                    other.camera.eye.y += aside;
                    draw(&other);
                }
                draw(list)
            };
            let anew: Vec<_> = lists.iter().map(anew).collect();
            // It rests from the second picture on.
            for _ in 0..2 {
                draw(&lists[0]);
            }
            for (number, (list, new)) in lists.iter().zip(&anew).enumerate() {
                // A look from elsewhere leaves its distances where nothing moves.
                let mut other = list.clone();
                other.camera.eye += DVec3::new(0.3, 0.4, 0.5);
                draw(&other);
                let old = draw(list);
                let others = new.iter().zip(&old).filter(|(a, b)| a != b).count();
                assert_eq!(others, 0, "list {number}, {settings:?}, {pose:?}");
            }
        }
    }
}

#[test]
fn an_eye_that_moves_away_sees_no_old_picture() {
    let stage = Stage::new(&load_scene("break_shot").unwrap(), "break_shot").unwrap();
    let settings = PictureSettings { smooth: Smoothing::Off, ..PictureSettings::default() };
    let Some(mut studio) = studio(&stage.table) else { return };
    let here = &lists(&stage, CameraPose::default())[1];
    let beside = CameraPose { eye: CameraPose::default().eye + DVec3::Y * 1e-3, ..here.camera };
    let there = DrawList { camera: beside, ..here.clone() };
    let mut draw = |list: &DrawList| studio.pixels(list, &settings, SIZE).unwrap();
    let first = draw(here);
    let other = draw(&there);
    assert!(first != other, "a millimetre is not seen");
    // To and fro, resting here and there.
    for _ in 0..3 {
        assert!(draw(here) == first && draw(here) == first);
        assert!(draw(&there) == other && draw(&there) == other);
    }
}
