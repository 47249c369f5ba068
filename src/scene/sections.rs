//! One function per section of a scene file: keys, types, units, ranges.

mod player;

use super::reader::{Limits, Section, Source};
use super::*;
use crate::ball::{POOL_MASS_KG, POOL_RADIUS_M};
use crate::physics::{
    BallLaw, CushionLaw, ExactTolerances, Integrator, MultiContact, Profile, SolverKind,
};
use glam::DQuat;
use player::player;
use toml::de::DeTable;

/// The sections in the order in which a reader expects them.
const SECTIONS: [&str; 17] = [
    "scene", "physics", "table", "mesh", "plane", "box", "balls", "ball", "cue", "rules", "player",
    "camera", "renderer", "sound", "haptic", "input", "actors",
];

const PLACE: Limits = Limits { low: -1000.0, high: 1000.0, unit: "(m)", example: "0.0" };
const SPEED: Limits = Limits { low: -100.0, high: 100.0, unit: "(m/s)", example: "0.0" };
const SPIN: Limits = Limits { low: -10_000.0, high: 10_000.0, unit: "(rad/s)", example: "0.0" };

/// Reads a whole file and checks that its parts fit each other.
pub(super) fn parse(file_name: &str, text: &str) -> Result<Scene, SceneError> {
    if text.len() > FILE_BYTES_MAX {
        let found = format!("{} bytes", text.len());
        let allowed = format!("a scene has at most {FILE_BYTES_MAX} bytes");
        let fix = "move large meshes to files of their own";
        return Err(SceneError::new(file_name, 1, "size", Some(&found), &allowed, fix));
    }
    let source = Source { file: file_name, text };
    let table = DeTable::parse(text).map_err(|error| {
        let line = source.line(error.span().map_or(0, |span| span.start));
        let fix = "see https://toml.io for how values are written";
        SceneError::new(file_name, line, "TOML", None, error.message(), fix)
    })?;
    let root = Section::root(&source, table.get_ref());
    root.allow(&SECTIONS)?;

    let scene = Scene {
        file: file_name.to_string(),
        about: about(&root)?,
        physics: physics(&root)?,
        table: root.section("table")?.map(|section| table_section(&section)).transpose()?,
        meshes: each(&root, "mesh", MESHES_MAX, mesh)?,
        planes: each(&root, "plane", MESHES_MAX, plane)?,
        boxes: each(&root, "box", MESHES_MAX, box_section)?,
        balls: root.section("balls")?.map(|section| balls(&section)).transpose()?,
        ball: each(&root, "ball", BALLS_MAX, ball)?,
        cue: root.section("cue")?.map(|section| cue(&section)).transpose()?,
        rules: root.section("rules")?.map(|section| rules(&section)).transpose()?,
        players: each(&root, "player", 2, player)?,
        camera: empty(&root, "camera")?.then_some(CameraSection),
        renderer: root.section("renderer")?.map(|section| renderer(&section)).transpose()?,
        sound: root.section("sound")?.map(|section| sound(&section)).transpose()?,
        haptic: root.section("haptic")?.map(|section| haptic(&section)).transpose()?,
        input: root.section("input")?.map(|section| input(&section)).transpose()?,
        actors: root.section("actors")?.map(|section| actors(&section)).transpose()?,
    };
    check::check(&scene, &root)?;
    Ok(scene)
}

fn each<T>(
    root: &Section<'_>,
    key: &str,
    limit: usize,
    read: impl Fn(&Section<'_>) -> Result<T, SceneError>,
) -> Result<Vec<T>, SceneError> {
    root.entries(key, limit)?.iter().map(read).collect()
}

/// Whether a section without keys is there.
fn empty(root: &Section<'_>, key: &str) -> Result<bool, SceneError> {
    let Some(section) = root.section(key)? else { return Ok(false) };
    section.allow(&[])?;
    Ok(true)
}

fn about(root: &Section<'_>) -> Result<About, SceneError> {
    let Some(section) = root.section("scene")? else {
        return Err(root.missing(
            "scene",
            "every scene has a section [scene]",
            "write [scene] and name = \"My scene\"",
        ));
    };
    section.allow(&["name", "description", "seed"])?;
    let Some(name) = section.text("name", "My scene")? else {
        return Err(section.missing(
            "name",
            "every scene has a name",
            "write for example name = \"My scene\"",
        ));
    };
    Ok(About {
        name,
        description: section.text("description", "What it shows")?.unwrap_or_default(),
        seed: section.integer("seed", 0..=i64::MAX as u64)?.unwrap_or(0),
    })
}

fn physics(root: &Section<'_>) -> Result<PhysicsSettings, SceneError> {
    let Some(section) = root.section("physics")? else {
        return Err(root.missing(
            "physics",
            "every scene has a section [physics]",
            "write [physics]; each of its keys has a default",
        ));
    };
    section.allow(&[
        "solver",
        "step_ms",
        "integrator",
        "sub_steps",
        "profile",
        "ball_law",
        "cushion_law",
        "multi_contact",
        "hop_m_s",
        "lasting_step_ms",
        "gravity_m_s2",
        "ball_friction",
        "flight",
        "contact_back_dating",
        "thread",
    ])?;
    let default = PhysicsSettings::default();
    let step = Limits { low: 0.001, high: 50.0, unit: "(ms)", example: "4.0" };
    let hop = Limits { low: 1e-9, high: 1.0, unit: "(m/s)", example: "2e-3" };
    let lasting = Limits { low: 1e-3, high: 50.0, unit: "(ms)", example: "0.5" };
    let gravity = Limits { low: 0.0, high: 1000.0, unit: "(m/s², downwards)", example: "9.81" };
    let solvers: [(&[&str], SolverKind); 2] =
        [(&["event-driven"], SolverKind::EventDriven), (&["fixed-step"], SolverKind::FixedStep)];
    let integrators: [(&[&str], Integrator); 4] = [
        (&["euler-cromer"], Integrator::EulerCromer),
        (&["verlet"], Integrator::Verlet),
        (&["position-verlet"], Integrator::PositionVerlet),
        (&["rk4"], Integrator::Rk4),
    ];
    let profiles: [(&[&str], Profile); 2] =
        [(&["standard"], Profile::Standard), (&["2009"], Profile::Paper2009)];
    let ball_laws: [(&[&str], BallLaw); 3] = [
        (&["coulomb"], BallLaw::Coulomb),
        (&["speed-dependent"], BallLaw::SpeedDependent),
        (&["mathavan-2014"], BallLaw::Mathavan2014),
    ];
    let cushion_laws: [(&[&str], CushionLaw); 3] = [
        (&["combined"], CushionLaw::Combined),
        (&["han-2005"], CushionLaw::Han2005),
        (&["mathavan-2010"], CushionLaw::Mathavan2010),
    ];
    let rules: [(&[&str], MultiContact); 3] = [
        (&["rounds"], MultiContact::Rounds),
        (&["hertz"], MultiContact::Hertz),
        (&["pairwise"], MultiContact::Pairwise),
    ];
    let solver = section.choice("solver", &solvers)?.unwrap_or(default.solver);
    let profile = section.choice("profile", &profiles)?.unwrap_or(default.profile);
    if (solver, profile) == (SolverKind::EventDriven, Profile::Paper2009) {
        return Err(section.error(
            "profile",
            "\"2009\" is the paper's fixed step with its faults, and event-driven has no steps",
            "add solver = \"fixed-step\", or write profile = \"standard\"",
        ));
    }
    let sub_steps = section.integer("sub_steps", 1..=10_000)?;
    if sub_steps.is_some_and(|parts| parts > 1) && profile == Profile::Paper2009 {
        return Err(section.error(
            "sub_steps",
            "under profile \"2009\" a lying ball has a contact in every step",
            "leave it out and write a smaller step_ms, or write profile = \"standard\"",
        ));
    }
    let flight = section.switch("flight")?.unwrap_or(default.flight);
    if !flight && solver == SolverKind::FixedStep {
        return Err(section.error(
            "flight",
            "fixed-step lets balls hop",
            "write solver = \"event-driven\", or leave flight out",
        ));
    }
    Ok(PhysicsSettings {
        solver,
        step_ms: section.number("step_ms", step)?.unwrap_or(default.step_ms),
        integrator: section.choice("integrator", &integrators)?.unwrap_or(default.integrator),
        sub_steps: sub_steps.map_or(default.sub_steps, |parts| parts as u32),
        profile,
        ball_law: section.choice("ball_law", &ball_laws)?.unwrap_or(default.ball_law),
        cushion_law: section.choice("cushion_law", &cushion_laws)?.unwrap_or(default.cushion_law),
        multi_contact: section.choice("multi_contact", &rules)?.unwrap_or(default.multi_contact),
        exact: ExactTolerances {
            hop_m_s: section.number("hop_m_s", hop)?.unwrap_or(default.exact.hop_m_s),
            lasting_step_s: section
                .number("lasting_step_ms", lasting)?
                .map_or(default.exact.lasting_step_s, |step_ms| step_ms / 1000.0),
        },
        gravity_m_s2: section.number("gravity_m_s2", gravity)?.unwrap_or(default.gravity_m_s2),
        ball_friction: section.switch("ball_friction")?.unwrap_or(default.ball_friction),
        flight,
        contact_back_dating: section
            .switch("contact_back_dating")?
            .unwrap_or(default.contact_back_dating),
        thread: section.switch("thread")?.unwrap_or(default.thread),
    })
}

fn table_section(section: &Section<'_>) -> Result<TableSection, SceneError> {
    section.allow(&["preset", "room"])?;
    let room = section.switch("room")?.unwrap_or(false);
    let names: Vec<([&'static str; 1], &'static str)> =
        crate::shipped::TABLES.iter().map(|(name, _)| ([*name], *name)).collect();
    let choices: Vec<(&[&'static str], &'static str)> =
        names.iter().map(|(names, name)| (&names[..], *name)).collect();
    match section.choice("preset", &choices)? {
        Some(preset) => Ok(TableSection { preset: preset.to_string(), room, line: section.line() }),
        None => Err(section.missing(
            "preset",
            "a table needs a preset",
            "write preset = \"pool-9ft\", or use [[plane]], [[box]] and [[mesh]] instead",
        )),
    }
}

fn surface(section: &Section<'_>) -> Result<Surface, SceneError> {
    let surfaces: [(&[&str], Surface); 4] = [
        (&["obstacle"], Surface::Obstacle),
        (&["cloth"], Surface::Cloth),
        (&["wood"], Surface::Wood),
        (&["floor"], Surface::Floor),
    ];
    Ok(section.choice("surface", &surfaces)?.unwrap_or(Surface::Obstacle))
}

fn mesh(section: &Section<'_>) -> Result<MeshSection, SceneError> {
    section.allow(&["file", "surface", "offset_m", "scale"])?;
    let Some(file) = section.text("file", "course.obj")? else {
        return Err(section.missing(
            "file",
            "a mesh is read from a Wavefront OBJ file",
            "write for example file = \"course.obj\"",
        ));
    };
    if file.is_empty() {
        let allowed = "the name of a Wavefront OBJ file";
        return Err(section.error("file", allowed, "write for example file = \"course.obj\""));
    }
    let scale = Limits { low: 1e-6, high: 1e6, unit: "", example: "1.0" };
    Ok(MeshSection {
        file,
        surface: surface(section)?,
        offset_m: section.vector("offset_m", PLACE)?.unwrap_or(DVec3::ZERO),
        scale: section.number("scale", scale)?.unwrap_or(1.0),
        line: section.line(),
    })
}

fn plane(section: &Section<'_>) -> Result<Plane, SceneError> {
    section.allow(&["point_m", "normal", "surface"])?;
    let component = Limits { low: -1000.0, high: 1000.0, unit: "", example: "1.0" };
    let normal = match section.vector("normal", component)? {
        Some(normal) => normal.try_normalize().ok_or_else(|| {
            section.error(
                "normal",
                "expected a vector that is not zero, towards the free side",
                "write for example normal = [0, 0, 1]",
            )
        })?,
        None => DVec3::Z,
    };
    let is_ground = section.length("surface").is_none() && normal.z > 0.5;
    let surface = match section.text("surface", "cloth")? {
        Some(_) => surface(section)?,
        // Ground to play on is cloth unless the scene says otherwise; a wall is an obstacle.
        None if is_ground => Surface::Cloth,
        None => Surface::Obstacle,
    };
    let point = section.vector("point_m", PLACE)?.unwrap_or(DVec3::ZERO);
    Ok(Plane { point, normal, surface })
}

fn box_section(section: &Section<'_>) -> Result<BoxSection, SceneError> {
    section.allow(&["centre_m", "size_m", "surface"])?;
    let edge = Limits { low: 1e-4, high: 1000.0, unit: "(m)", example: "0.1" };
    let Some(centre_m) = section.vector("centre_m", PLACE)? else {
        let fix = "write for example centre_m = [0, 0, 0.05]";
        return Err(section.missing("centre_m", "a box has a middle (m)", fix));
    };
    let Some(size_m) = section.vector("size_m", edge)? else {
        let fix = "write for example size_m = [0.1, 0.1, 0.1]";
        return Err(section.missing("size_m", "a box has three edges (m)", fix));
    };
    Ok(BoxSection { centre_m, size_m, surface: surface(section)? })
}

fn balls(section: &Section<'_>) -> Result<BallsSection, SceneError> {
    section.allow(&["rack"])?;
    let racks: [(&[&str], RackKind); 4] = [
        (&["eight-ball"], RackKind::EightBall),
        (&["nine-ball"], RackKind::NineBall),
        (&["snooker"], RackKind::Snooker),
        (&["carom"], RackKind::Carom),
    ];
    match section.choice("rack", &racks)? {
        Some(rack) => Ok(BallsSection { rack, line: section.line() }),
        None => Err(section.missing(
            "rack",
            "[balls] sets up a rack",
            "write for example rack = \"eight-ball\", or list each ball as [[ball]]",
        )),
    }
}

fn ball(section: &Section<'_>) -> Result<BallSection, SceneError> {
    section.allow(&[
        "id",
        "radius_m",
        "mass_kg",
        "inertia_factor",
        "position_m",
        "velocity_m_s",
        "angular_velocity_rad_s",
        "flags",
        "spring",
    ])?;
    let Some(id) = section.integer("id", 0..=u64::from(u16::MAX))? else {
        let allowed = "every ball has a number";
        return Err(section.missing("id", allowed, "write for example id = 1; the cue ball is 0"));
    };
    let radius = Limits { low: 1e-4, high: 10.0, unit: "(m)", example: "0.028575" };
    let mass = Limits { low: 1e-6, high: 1e6, unit: "(kg)", example: "0.17" };
    let inertia = Limits { low: 1e-3, high: 1.0, unit: "", example: "0.4" };
    let radius_m = section.number("radius_m", radius)?.unwrap_or(POOL_RADIUS_M);
    // Two numbers put the ball on z = 0, three say its height as well.
    let position_m = if section.length("position_m") == Some(2) {
        section.numbers::<2>("position_m", PLACE)?.map(|[x, y]| DVec3::new(x, y, radius_m))
    } else {
        section.vector("position_m", PLACE)?
    };
    let Some(position_m) = position_m else {
        let fix = "write for example position_m = [0, 0]";
        return Err(section.missing("position_m", "a ball has a place (m)", fix));
    };
    let flags = section.section("flags")?.map(|section| flags(&section)).transpose()?;
    let spring = section.section("spring")?.map(|section| spring(&section)).transpose()?;
    Ok(BallSection {
        id: BallId(u16::try_from(id).unwrap_or(u16::MAX)),
        radius_m,
        mass_kg: section.number("mass_kg", mass)?.unwrap_or(POOL_MASS_KG),
        inertia_factor: section.number("inertia_factor", inertia)?.unwrap_or(INERTIA_DEFAULT),
        position_m,
        velocity_m_s: section.vector("velocity_m_s", SPEED)?.unwrap_or(DVec3::ZERO),
        angular_velocity_rad_s: section
            .vector("angular_velocity_rad_s", SPIN)?
            .unwrap_or(DVec3::ZERO),
        flags: flags.unwrap_or_default(),
        spring,
        line: section.line(),
    })
}

fn flags(section: &Section<'_>) -> Result<BallFlags, SceneError> {
    section.allow(&["gravity", "integrate", "collide"])?;
    Ok(BallFlags {
        gravity: section.switch("gravity")?.unwrap_or(true),
        integrate: section.switch("integrate")?.unwrap_or(true),
        collide: section.switch("collide")?.unwrap_or(true),
    })
}

fn spring(section: &Section<'_>) -> Result<Spring, SceneError> {
    section.allow(&[
        "anchor_m",
        "anchor_orientation",
        "stiffness_n_m",
        "damping_ns_m",
        "angular_stiffness_nm_rad",
        "angular_damping_nms_rad",
    ])?;
    let strength = |unit| Limits { low: 0.0, high: 1e7, unit, example: "100.0" };
    let number = |key, unit| Ok(section.number(key, strength(unit))?.unwrap_or(0.0));
    let component = Limits { low: -1.0, high: 1.0, unit: "", example: "0.5" };
    let anchor_orientation = match section.numbers::<4>("anchor_orientation", component)? {
        Some(numbers) if DQuat::from_array(numbers).length() > 0.1 => {
            DQuat::from_array(numbers).normalize()
        }
        Some(_) => {
            return Err(section.error(
                "anchor_orientation",
                "expected a unit quaternion x, y, z, w",
                "write for example anchor_orientation = [0, 0, 0, 1]",
            ));
        }
        None => DQuat::IDENTITY,
    };
    Ok(Spring {
        anchor_m: section.vector("anchor_m", PLACE)?.unwrap_or(DVec3::ZERO),
        anchor_orientation,
        stiffness_n_m: number("stiffness_n_m", "(N/m)")?,
        damping_ns_m: number("damping_ns_m", "(N s/m)")?,
        angular_stiffness_nm_rad: number("angular_stiffness_nm_rad", "(N m/rad)")?,
        angular_damping_nms_rad: number("angular_damping_nms_rad", "(N m s/rad)")?,
    })
}

fn rules(section: &Section<'_>) -> Result<RulesSection, SceneError> {
    section.allow(&["game", "first_player"])?;
    let first = section.integer("first_player", 1..=2)?.unwrap_or(1);
    let first_player = PlayerId(first as u8);
    let games = GameKind::ALL.map(|game| ([game.id(), game.short_id()], game));
    let choices: Vec<(&[&'static str], GameKind)> =
        games.iter().map(|(names, game)| (&names[..], *game)).collect();
    match section.choice("game", &choices)? {
        Some(game) => Ok(RulesSection { game, first_player }),
        None => Err(section.missing(
            "game",
            "[rules] names a game",
            "write for example game = \"paper-eight-ball\"",
        )),
    }
}

fn cue(section: &Section<'_>) -> Result<CueSection, SceneError> {
    section.allow(&[
        "tip_radius_m",
        "mass_kg",
        "end_mass_kg",
        "tip_restitution",
        "tip_friction",
    ])?;
    let radius = Limits { low: 1e-3, high: 10.0, unit: "(m)", example: "0.0106" };
    let mass = Limits { low: 1e-3, high: 100.0, unit: "(kg)", example: "0.54" };
    let share = Limits { low: 0.0, high: 1.0, unit: "", example: "0.75" };
    Ok(CueSection {
        tip_radius_m: section.number("tip_radius_m", radius)?,
        mass_kg: section.number("mass_kg", mass)?,
        end_mass_kg: section.number("end_mass_kg", mass)?,
        tip_restitution: section.number("tip_restitution", share)?,
        tip_friction: section.number("tip_friction", share)?,
    })
}

fn renderer(section: &Section<'_>) -> Result<RendererSection, SceneError> {
    section.allow(&["width", "height", "fullscreen"])?;
    let pixels = |key, default: u32| {
        let pixels = section.integer(key, 64..=16_384)?;
        Ok(pixels.and_then(|pixels| u32::try_from(pixels).ok()).unwrap_or(default))
    };
    Ok(RendererSection {
        width: pixels("width", 1280)?,
        height: pixels("height", 720)?,
        fullscreen: section.switch("fullscreen")?.unwrap_or(false),
    })
}

fn sound(section: &Section<'_>) -> Result<SoundSection, SceneError> {
    section.allow(&["device", "volume", "mode", "room", "room_tone", "recordings"])?;
    let volume = Limits { low: 0.0, high: 4.0, unit: "(1 is as in the world)", example: "1.0" };
    let device = section.text("device", "default")?;
    let recordings = section.text("recordings", "sounds")?;
    for (key, text) in [("device", &device), ("recordings", &recordings)] {
        if text.as_deref() == Some("") {
            let fix = format!("leave {key} out, or name one");
            return Err(section.error(key, "names nothing", &fix));
        }
    }
    Ok(SoundSection {
        device: device.filter(|name| name != "default"),
        volume: section.number("volume", volume)?.unwrap_or(1.0),
        mode: section.choice("mode", &SoundMode::WORDS)?.unwrap_or_default(),
        room: section.switch("room")?.unwrap_or(true),
        room_tone: section.switch("room_tone")?.unwrap_or(false),
        recordings,
    })
}

fn haptic(section: &Section<'_>) -> Result<HapticSection, SceneError> {
    let keys = ["device", "core", "priority", "spin_us", "scale", "stroke_gain", "overlay"];
    section.allow(&keys)?;
    let scale = Limits { low: 0.1, high: 20.0, unit: "(m of the world per m)", example: "2.0" };
    let gain = Limits { low: 1.0, high: 20.0, unit: "(along the shaft)", example: "2.75" };
    let text = section.text("device", "auto").ok().flatten();
    let nameless = |allowed: &str, fix: &str| Err(section.error("device", allowed, fix));
    let device = match text.as_deref() {
        Some("recorded:") => {
            let fix = "write for example device = \"recorded:stylus.jsonl\"";
            return nameless("names no recording", fix);
        }
        Some("openhaptics:") => {
            let fix = "write device = \"openhaptics\" for the only one";
            return nameless("names no device", fix);
        }
        text => match text.and_then(HapticDevice::named) {
            Some(device) => device,
            None if text.is_some_and(|text| text.starts_with("haply:")) => {
                let fix = "write for example device = \"haply:localhost:10001\"";
                return nameless("names no HOST:PORT", fix);
            }
            None => plain_device(section)?,
        },
    };
    let number = |key, range| -> Result<Option<u32>, SceneError> {
        Ok(section.integer(key, range)?.and_then(|number| u32::try_from(number).ok()))
    };
    Ok(HapticSection {
        device,
        core: number("core", 0..=1023)?,
        priority: number("priority", 1..=99)?,
        spin_us: number("spin_us", 0..=500)?,
        scale: section.number("scale", scale)?,
        stroke_gain: section.number("stroke_gain", gain)?,
        overlay: section.switch("overlay")?.unwrap_or(false),
    })
}

/// One of the devices that are named by one word; the first of them where nothing is written.
fn plain_device(section: &Section<'_>) -> Result<HapticDevice, SceneError> {
    let words: [&[&'static str]; 6] =
        [&["auto"], &["simulated"], &["mouse"], &["openhaptics"], &["haply"], &["none"]];
    let choices: Vec<(&[&'static str], usize)> =
        words.iter().enumerate().map(|(i, word)| (*word, i)).collect();
    let chosen = section.choice("device", &choices)?.unwrap_or(0);
    Ok(HapticDevice::PLAIN[chosen].clone())
}

fn input(section: &Section<'_>) -> Result<InputSection, SceneError> {
    section.allow(&["profile"])?;
    let profile = section.choice("profile", &[(&["default"], "default")])?;
    Ok(InputSection { profile: profile.unwrap_or("default").to_string() })
}

fn actors(section: &Section<'_>) -> Result<ActorsSection, SceneError> {
    section.allow(&["input"])?;
    let Some(text) = section.text("input", "recorded:game.jsonl")? else {
        return Ok(ActorsSection { input: None });
    };
    if text == "real" {
        return Ok(ActorsSection { input: None });
    }
    match text.strip_prefix("recorded:") {
        Some(file) if !file.is_empty() => {
            Ok(ActorsSection { input: Some(StandIn::Recorded(file.to_string())) })
        }
        _ => Err(section.error(
            "input",
            "expected \"real\" or \"recorded:FILE\"",
            "write for example input = \"recorded:game.jsonl\"",
        )),
    }
}
