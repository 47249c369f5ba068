//! How pictures are drawn: options, presets, levels of detail, eyes, lamps, films and the paper's
//! tables.

use glam::{DVec3, Vec3};
use hapticbillard::ball::{BallState, POOL_RADIUS_M};
use hapticbillard::ids::BallId;
use hapticbillard::input::{CameraPose, HumanView};
use hapticbillard::menu::{Menu, MenuInput, Pages, Setting, Settings};
use hapticbillard::physics::Snapshot;
use hapticbillard::picture::{
    BallDetail, BenchTable, Environment, FrameTimes, PictureError, PictureOption, PictureSettings,
    Preset, Shadows, Smoothing, Stereo, bench_markdown, bench_rows,
};
use hapticbillard::renderer::{
    BallSet, DrawList, FilmClock, LAMPS, ROD_SHADOW_TRIANGLES, Radii, SolidShape, draw_vectors,
    eyes, rod_shadow, y4m_frame, y4m_head,
};
use std::collections::BTreeSet;

#[test]
fn every_option_takes_each_of_its_values_in_words_and_by_place() {
    for option in PictureOption::ALL {
        for (place, value) in option.values().iter().enumerate() {
            let mut by_place = PictureSettings::default();
            by_place.put(option, place);
            let mut in_words = PictureSettings::default();
            in_words.read(&format!("{} = {value}", option.key())).unwrap();
            assert_eq!(by_place, in_words);
            assert_eq!((by_place.place(option), by_place.value(option)), (place, *value));
            // And nothing else.
            for other in PictureOption::ALL.into_iter().filter(|other| *other != option) {
                let usual = PictureSettings::default();
                assert_eq!(by_place.place(other), usual.place(other), "{option:?} {other:?}");
            }
        }
    }
}

#[test]
fn a_wrong_option_is_told_with_what_there_is() {
    let mut settings = PictureSettings::default();
    let mut told = |text: &str| settings.read(text).unwrap_err().to_string();
    assert!(told("shadows").contains("key=value"));
    assert!(told("shadow=off").contains("shadows, triangles"));
    assert!(told("triangles=1000").contains("320, 1280, 5120"));
    let error = settings.read("shadows=hard").unwrap_err();
    assert!(matches!(error, PictureError::Value { option: PictureOption::Shadows, .. }));
    assert_eq!(settings, PictureSettings::default());
}

#[test]
fn what_is_set_is_written_and_read_again() {
    for option in PictureOption::ALL {
        let mut settings = Settings::default();
        settings.picture.put(option, option.values().len() - 1);
        assert_eq!(Settings::parse(&settings.to_toml()).unwrap(), settings, "{option:?}");
    }
    // Numbers that nobody offers become the next that is there.
    let odd = "[picture]\ntriangles = 1000\nrender_scale = 3\ntexture = 65535\n";
    let picture = Settings::parse(odd).unwrap().picture;
    assert_eq!((picture.triangles, picture.render_scale, picture.texture), (1280, 50, 1024));
    assert!(Settings::parse("[picture]\nshadows = \"hard\"\n").is_err());
}

#[test]
fn presets_are_told_apart_and_keep_what_is_a_matter_of_taste() {
    let own = PictureSettings {
        stereo: Stereo::Middle,
        marks: true,
        vectors: true,
        hud_scale: 150,
        ..PictureSettings::default()
    };
    for preset in Preset::ALL {
        let applied = preset.applied(own);
        assert_eq!(Preset::of(&applied), Some(preset));
        let kept = (applied.stereo, applied.marks, applied.vectors, applied.hud_scale);
        assert_eq!(kept, (Stereo::Middle, true, true, 150));
    }
    assert_eq!(Preset::of(&PictureSettings::default()), Some(Preset::Medium));
    let other = PictureSettings { shadows: Shadows::Volumes, ..PictureSettings::default() };
    assert_eq!(Preset::of(&other), None);
    // Nothing gets cheaper on the way up.
    let cost = |preset: Preset| {
        let settings = preset.applied(PictureSettings::default());
        [PictureOption::Triangles, PictureOption::Texture, PictureOption::Environment]
            .into_iter()
            .chain([PictureOption::NormalMap, PictureOption::RenderScale, PictureOption::Smooth])
            .map(|option| settings.place(option))
            .collect::<Vec<_>>()
    };
    for pair in Preset::ALL.windows(2) {
        let both = cost(pair[0]).into_iter().zip(cost(pair[1]));
        assert!(both.clone().all(|(less, more)| less <= more), "{pair:?}");
        assert!(both.clone().any(|(less, more)| less < more), "{pair:?}");
    }
}

#[test]
fn the_menu_sets_a_preset_and_then_one_thing_of_it() {
    let mut menu = Menu::new(Pages::shipped().unwrap(), Settings::default());
    menu.open("graphics");
    // From medium to high, by keys; then the shadows by a click on their right arrow.
    menu.hear(MenuInput::More);
    assert_eq!(Preset::of(&menu.settings.picture), Some(Preset::High));
    menu.hear(MenuInput::Press { line: 2, share: Some(0.9) });
    assert_eq!(menu.settings.picture.shadows, Shadows::Maps);
    assert_eq!(Preset::of(&menu.settings.picture), None);
    // Everything there is stands on a page.
    let on_pages: BTreeSet<String> = Pages::shipped()
        .unwrap()
        .iter()
        .flat_map(|page| page.items.clone())
        .map(|item| format!("{:?}", item.effect))
        .collect();
    for option in PictureOption::ALL {
        let effect = format!("Sets({:?})", Setting::Picture(option));
        assert!(on_pages.contains(&effect), "{option:?} is on no page");
    }
}

#[test]
fn detail_leaves_with_distance_and_comes_back() {
    let settings = PictureSettings {
        triangles: 5120,
        environment: Environment::All,
        normal_map: true,
        ..PictureSettings::default()
    };
    let at = |radius_px: f32| BallDetail::of(radius_px, &settings);
    assert_eq!(at(3.0), BallDetail { level: 2, reflection: 0.0, scratches: 0.0 });
    assert_eq!(at(400.0), BallDetail { level: 4, reflection: 1.0, scratches: 1.0 });
    // Step by step, and never the other way.
    let all: Vec<BallDetail> = (1..400).map(|px| at(px as f32)).collect();
    for pair in all.windows(2) {
        assert!(pair[0].level <= pair[1].level);
        assert!(pair[0].reflection <= pair[1].reflection + 1e-6);
        assert!(pair[0].scratches <= pair[1].scratches + 1e-6);
    }
    assert_eq!(all.iter().map(|d| d.level).collect::<BTreeSet<_>>(), BTreeSet::from([2, 3, 4]));
    // Reflections stay when scratches have gone.
    assert!(at(20.0).reflection == 1.0 && at(20.0).scratches == 0.0);
    // Nobody gets more than is set, and without levels of detail everybody gets that.
    let plain = PictureSettings { triangles: 320, environment: Environment::Off, ..settings };
    assert_eq!(
        (BallDetail::of(400.0, &plain).level, BallDetail::of(400.0, &plain).reflection),
        (2, 0.0)
    );
    let whole = PictureSettings { level_of_detail: false, ..settings };
    assert_eq!(BallDetail::of(1.0, &whole), at(400.0));
}

#[test]
fn outlines_are_off_by_less_than_half_a_pixel() {
    let settings = PictureSettings { triangles: 5120, ..PictureSettings::default() };
    for radius_px in [10.0f32, 29.0, 60.0, 110.0, 200.0, 400.0] {
        let level = BallDetail::of(radius_px, &settings).level;
        let shape = hapticbillard::renderer::sphere(level);
        let point = |i: u32| Vec3::from(shape.positions[i as usize]);
        let flattest = shape.indices.chunks(3).flat_map(|t| [(t[0], t[1]), (t[1], t[2])]);
        let off = flattest.map(|(a, b)| 1.0 - (0.5 * (point(a) + point(b))).length());
        let off_px = off.fold(0.0, f32::max) * radius_px;
        assert!(off_px < 0.5, "{off_px} pixels at {radius_px}");
    }
}

#[test]
fn what_is_drawn_is_a_part_of_the_window() {
    let settings = PictureSettings { render_scale: 50, ..PictureSettings::default() };
    assert_eq!(settings.drawn_size((1440, 900)), (720, 450));
    assert_eq!(settings.drawn_size((1, 1)), (1, 1));
    assert_eq!(PictureSettings::default().drawn_size((1441, 907)), (1441, 907));
    assert!(Smoothing::Auto.is_on(false) && !Smoothing::Auto.is_on(true));
    assert!(Smoothing::On.is_on(true) && !Smoothing::Off.is_on(false));
}

#[test]
fn eyes_are_as_far_apart_as_eyes_and_one_of_them_is_where_it_was_set() {
    let pose = CameraPose::default();
    assert_eq!(eyes(&pose, Stereo::Off), None);
    for (stereo, at) in [(Stereo::Left, 0.0), (Stereo::Middle, 0.5), (Stereo::Right, 1.0)] {
        let [left, right] = eyes(&pose, stereo).unwrap();
        assert!((left.eye.distance(right.eye) - 0.063).abs() < 1e-12);
        assert!(left.eye.lerp(right.eye, at).distance(pose.eye) < 1e-12, "{stereo:?}");
        // The right eye is on the right, both at the same height, and both see the same thing.
        let aside = (pose.target - pose.eye).cross(DVec3::Z);
        assert!((right.eye - left.eye).dot(aside) > 0.0 && left.eye.z == right.eye.z);
        assert_eq!((left.target, right.target), (pose.target, pose.target));
    }
    // What is near is seen by eyes that are nearer to each other.
    let near = CameraPose { eye: DVec3::new(0.0, -0.3, 0.1), target: DVec3::ZERO, ..pose };
    let [left, right] = eyes(&near, Stereo::Middle).unwrap();
    assert!(left.eye.distance(right.eye) < 0.012);
}

#[test]
fn the_darkness_behind_a_rod_is_a_closed_body_that_turns_outwards() {
    let ends = [([0.1, 0.2, 0.05], 0.006), ([-1.3, 0.1, 0.25], 0.0145)];
    for lamp in LAMPS {
        let corners = rod_shadow(lamp, ends, -0.12).unwrap().map(Vec3::from);
        let middle = corners.iter().sum::<Vec3>() / 8.0;
        let mut edges = BTreeSet::new();
        for t in ROD_SHADOW_TRIANGLES.chunks(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| corners[i as usize]);
            let normal = (b - a).cross(c - a);
            assert!(normal.dot((a + b + c) / 3.0 - middle) > 0.0, "{t:?} at {lamp:?}");
            for edge in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                assert!(edges.insert(edge), "{edge:?} twice");
            }
        }
        assert!(edges.iter().all(|(a, b)| edges.contains(&(*b, *a))));
        // It ends below the cloth, and begins at the rod.
        assert!(corners[4..].iter().all(|corner| (corner.z + 0.12).abs() < 1e-3));
        assert!((corners[0].distance(Vec3::from(ends[0].0)) - 0.006).abs() < 1e-6);
    }
    let [x, y, z] = LAMPS[1];
    assert_eq!(
        rod_shadow(LAMPS[1], [([x, y, z - 0.2], 0.01), ([x, y, z - 1.0], 0.01)], -0.1),
        None
    );
}

fn moving(velocity: DVec3, angular_velocity: DVec3) -> Snapshot {
    let at = DVec3::new(0.0, 0.0, POOL_RADIUS_M);
    let ball = BallState { velocity, angular_velocity, ..BallState::at_rest(BallId(1), at) };
    Snapshot { time_s: 0.0, balls: vec![ball], cue: None }
}

#[test]
fn arrows_show_velocity_spin_and_slip() {
    let drawn = |world: &Snapshot| {
        let mut list = DrawList::new(world, &HumanView::default(), &Radii::default());
        draw_vectors(world, &Radii::default(), &mut list);
        let heads = list.solids.into_iter().filter(|solid| solid.shape == SolidShape::Cone);
        heads.map(|head| Vec3::from(head.to)).collect::<Vec<_>>()
    };
    assert!(drawn(&moving(DVec3::ZERO, DVec3::ZERO)).is_empty());
    // Struck in the middle: velocity, and all of it is slip.
    let heads = drawn(&moving(DVec3::X, DVec3::ZERO));
    assert_eq!(heads.len(), 2);
    assert!((heads[0].x - 0.08).abs() < 1e-6 && (heads[1].x - 0.08).abs() < 1e-6);
    assert!(heads[0].z > heads[1].z);
    // Rolling: no slip; the axis of a ball that rolls along x is y.
    let heads = drawn(&moving(DVec3::X, DVec3::Y / POOL_RADIUS_M));
    assert_eq!(heads.len(), 2);
    assert!((heads[1].y - 0.08).abs() < 1e-6, "{heads:?}");
}

#[test]
fn marked_balls_are_told_apart_by_number_or_by_brightness() {
    let brightness = |[r, g, b]: [f32; 3]| {
        let [r, g, b] = [r, g, b].map(|channel| channel.powf(2.2));
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    for (set, balls) in
        [(BallSet::Pool, 0..16u16), (BallSet::Snooker, 14..22), (BallSet::Carom, 0..3)]
    {
        let looks: Vec<_> = balls.map(|ball| set.marked_look(BallId(ball))).collect();
        for (i, a) in looks.iter().enumerate() {
            for b in looks[..i].iter().filter(|b| b.number == a.number) {
                // Two reds of snooker are the same; everything else is not.
                let same_red = set == BallSet::Snooker && a.number == Some(1);
                let apart = (brightness(a.colour) - brightness(b.colour)).abs() > 0.1;
                assert!(same_red || apart, "{set:?}: {a:?} and {b:?}");
            }
            assert_eq!(a.has_six, a.number.is_some());
        }
    }
    // Without marks nothing changes.
    let mut radii = Radii::default();
    assert_eq!(radii.look(BallId(3)), BallSet::Pool.look(BallId(3)));
    radii.mark(true);
    assert_eq!(radii.look(BallId(3)), BallSet::Pool.marked_look(BallId(3)));
}

#[test]
fn frames_of_a_film_show_exact_moments() {
    let clock = FilmClock { fps: 60, speed: 1.0, from_s: 2.0 };
    assert_eq!(clock.moment_s(0), 2.0);
    assert_eq!(clock.moment_s(6_000_000), 2.0 + 100_000.0);
    assert_eq!(clock.frames_in(1.0), 61);
    let slow = FilmClock { speed: 0.1, ..clock };
    assert_eq!(slow.frames_in(0.3), 181);
    assert!((slow.moment_s(180) - 2.3).abs() < 1e-12);
}

#[test]
fn films_have_the_colours_of_television() {
    assert_eq!(y4m_head((640, 400), 30), "YUV4MPEG2 W640 H400 F30:1 Ip A1:1 C444\n");
    let pixels = [[0, 0, 0, 255], [255, 255, 255, 255], [255, 0, 0, 255], [0, 0, 255, 255]];
    let frame = y4m_frame(&pixels);
    assert_eq!(&frame[..6], b"FRAME\n");
    // ITU-R BT.601: black 16, white 235, pure red 81 90 240, pure blue 41 240 110.
    assert_eq!(frame[6..10], [16, 235, 81, 41]);
    assert_eq!(frame[10..14], [128, 128, 90, 240]);
    assert_eq!(frame[14..18], [128, 128, 240, 110]);
}

#[test]
fn the_papers_tables_are_whole() {
    let rows = bench_rows();
    let of = |table| rows.iter().filter(move |row| row.table == table);
    let figures = |table| of(table).filter_map(|row| row.fps_2009).collect::<Vec<_>>();
    assert_eq!(figures(BenchTable::Triangles), [62.0, 55.0, 59.0, 50.0, 56.0, 4.0]);
    assert_eq!(figures(BenchTable::Textures), [65.0, 68.0, 74.0]);
    assert_eq!(figures(BenchTable::Effects), [56.0, 48.0, 54.0, 47.0]);
    assert!(of(BenchTable::Textures).all(|row| row.settings.shadows == Shadows::Off));
    let papers = rows.iter().filter(|row| row.preset.is_none());
    assert!(papers.clone().all(|row| row.settings.smooth == Smoothing::Off));
    assert!(papers.clone().all(|row| !row.settings.level_of_detail));
    let names: BTreeSet<_> = rows.iter().map(|row| (row.table, row.name())).collect();
    assert_eq!(names.len(), rows.len());
    let measured: Vec<_> =
        rows.iter().map(|row| (*row, FrameTimes { median: 20.0, p95: 25.0 })).collect();
    let text = bench_markdown(&measured, "a card", (1440, 900), false);
    assert!(text.contains("| 5120 triangles, shadow volumes | 20.0 ms | 25.0 ms | 50 | 4 |"));
}

#[test]
fn half_of_all_times_are_below_the_median() {
    let times: Vec<f64> = (1..=20).map(|ms| f64::from(ms) * 1e-3).collect();
    assert_eq!(FrameTimes::of(&times), Some(FrameTimes { median: 10.0, p95: 19.0 }));
    assert_eq!(FrameTimes::of(&[]), None);
}
