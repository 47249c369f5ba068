//! Every way to get a scene wrong, and the exact line that says so.

use hapticbillard::ids::{BallId, GameKind};
use hapticbillard::scene::{FILE_BYTES_MAX, Scene};

/// The smallest scene: what most of the wrong ones begin with.
const HEAD: &str = "[scene]\nname = \"x\"\n[physics]\n";

#[track_caller]
fn whole(text: &str, expected: &str) {
    let error = Scene::parse("s.toml", text).expect_err("this scene is wrong").to_string();
    assert_eq!(error, format!("s.toml:{expected}"), "\n{text}");
}

#[track_caller]
fn after_head(text: &str, expected: &str) {
    whole(&format!("{HEAD}{text}"), expected);
}

#[test]
fn whatever_is_wrong_is_said_in_one_exact_line() {
    // What the wrong scenes are made of is right.
    assert!(Scene::parse("s.toml", HEAD).is_ok());
    whole(
        "",
        "1: scene: missing, every scene has a section [scene]; write [scene] and name = \"My \
         scene\"",
    );
    whole(
        "[physics]\n",
        "1: scene: missing, every scene has a section [scene]; write [scene] and name = \"My \
         scene\"",
    );
    whole(
        "[scene]\nname = \"x\"\n",
        "1: physics: missing, every scene has a section [physics]; write [physics]; each of its \
         keys has a default",
    );
    whole(
        "[scene]\n[physics]\n",
        "1: scene.name: missing, every scene has a name; write for example name = \"My scene\"",
    );
    whole(
        "[scene\n",
        "1: TOML: unclosed table, expected `]`; see https://toml.io for how values are written",
    );
    whole(
        "[scene]\nname = \"x\n",
        "2: TOML: invalid basic string, expected `\"`; see https://toml.io for how values are \
         written",
    );
    whole(
        "[scene]\nname = \"x\"\nname = \"y\"\n[physics]\n",
        "3: TOML: duplicate key; see https://toml.io for how values are written",
    );
    after_head(
        "[phsyics]\n",
        "4: phsyics: this build knows the sections scene, physics, table, mesh, plane, box, \
         balls, ball, cue, rules, player, camera, renderer, sound, haptic, input, actors; \
         did you mean physics?",
    );
    after_head(
        "[chalk]\n",
        "4: chalk: this build knows the sections scene, physics, table, mesh, plane, box, balls, \
         ball, cue, rules, player, camera, renderer, sound, haptic, input, actors; \
         remove this section",
    );
    whole(
        "title = 3\n[scene]\nname = \"x\"\n[physics]\n",
        "1: title = 3: this build knows the sections scene, physics, table, mesh, plane, box, \
         balls, ball, cue, rules, player, camera, renderer, sound, haptic, input, actors; \
         remove this section",
    );
    after_head(
        "[banana]\n",
        "4: banana: this build knows the sections scene, physics, table, mesh, plane, box, \
         balls, ball, cue, rules, player, camera, renderer, sound, haptic, input, actors; \
         remove this section",
    );
    whole(
        "[[scene]]\nname = \"x\"\n",
        "1: scene: must be one section; write [scene] once, with single brackets",
    );
    whole("scene = 3\n", "1: scene = 3: must be a table of keys; write [scene]");
    after_head(
        "[ball]\nid = 1\n",
        "4: ball: must be a list of entries; write [[ball]] with double brackets",
    );
    whole(
        "ball = [1]\n[scene]\nname = \"x\"\n[physics]\n",
        "1: ball[0] = 1: must be a table of keys; write [[ball]] with double brackets",
    );
    whole(
        "[scene]\nname = 7\n[physics]\n",
        "2: scene.name = 7: expected a line in quotes, at most 4096 characters; write for \
         example name = \"My scene\"",
    );
    whole(
        "[scene]\nname = \"x\"\nseed = -1\n[physics]\n",
        "3: scene.seed = -1: expected a whole number from 0 to 9223372036854775807; write for \
         example seed = 0",
    );
    whole(
        "[scene]\nname = \"x\"\nseed = 1.5\n[physics]\n",
        "3: scene.seed = 1.5: expected a whole number from 0 to 9223372036854775807; write for \
         example seed = 0",
    );
    after_head(
        "ball_friction = \"yes\"\n",
        "4: physics.ball_friction = \"yes\": expected true or false; write ball_friction = true",
    );
    after_head(
        "step_ms = \"4\"\n",
        "4: physics.step_ms = \"4\": expected a number from 0.001 to 50 (ms); write for example \
         step_ms = 4.0",
    );
    after_head(
        "step_ms = nan\n",
        "4: physics.step_ms = nan: expected a number from 0.001 to 50 (ms); write for example \
         step_ms = 4.0",
    );
    after_head(
        "gravity_m_s2 = inf\n",
        "4: physics.gravity_m_s2 = inf: expected a number from 0 to 1000 (m/s², downwards); \
         write for example gravity_m_s2 = 9.81",
    );
    after_head(
        "gravity_m_s2 = -9.81\n",
        "4: physics.gravity_m_s2 = -9.81: expected a number from 0 to 1000 (m/s², downwards); \
         write for example gravity_m_s2 = 9.81",
    );
    after_head(
        "step_ms = 0\n",
        "4: physics.step_ms = 0: expected a number from 0.001 to 50 (ms); write for example \
         step_ms = 4.0",
    );
    after_head(
        "step_ms = 51\n",
        "4: physics.step_ms = 51: expected a number from 0.001 to 50 (ms); write for example \
         step_ms = 4.0",
    );
    after_head(
        "step_ms = 1e400\n",
        "4: physics.step_ms = 1e400: expected a number from 0.001 to 50 (ms); write for example \
         step_ms = 4.0",
    );
    after_head(
        "step_s = 0.004\n",
        "4: physics.step_s = 0.004: physics has the keys solver, step_ms, integrator, sub_steps, \
         profile, ball_law, cushion_law, multi_contact, hop_m_s, lasting_step_ms, gravity_m_s2, \
         ball_friction, flight, contact_back_dating, thread; did you mean step_ms?",
    );
    after_head(
        "gravity = 9.81\n",
        "4: physics.gravity = 9.81: physics has the keys solver, step_ms, integrator, sub_steps, \
         profile, ball_law, cushion_law, multi_contact, hop_m_s, lasting_step_ms, gravity_m_s2, \
         ball_friction, flight, contact_back_dating, thread; did you mean gravity_m_s2?",
    );
    after_head(
        "solver = \"exact\"\n",
        "4: physics.solver = \"exact\": this build knows \"event-driven\", \"fixed-step\"; write \
         for example solver = \"event-driven\"",
    );
    after_head(
        "solver = \"fixed-stpe\"\n",
        "4: physics.solver = \"fixed-stpe\": this build knows \"event-driven\", \"fixed-step\"; \
         did you mean \"fixed-step\"?",
    );
    after_head(
        "integrator = \"euler\"\n",
        "4: physics.integrator = \"euler\": this build knows \"euler-cromer\", \"verlet\", \
         \"position-verlet\", \"rk4\"; write for example integrator = \"euler-cromer\"",
    );
    after_head(
        "integrator = \"rk5\"\n",
        "4: physics.integrator = \"rk5\": this build knows \"euler-cromer\", \"verlet\", \
         \"position-verlet\", \"rk4\"; did you mean \"rk4\"?",
    );
    after_head(
        "ball_law = \"mathavan\"\n",
        "4: physics.ball_law = \"mathavan\": this build knows \"coulomb\", \"speed-dependent\", \
         \"mathavan-2014\"; write for example ball_law = \"coulomb\"",
    );
    after_head(
        "cushion_law = \"stronge\"\n",
        "4: physics.cushion_law = \"stronge\": this build knows \"combined\", \"han-2005\", \
         \"mathavan-2010\"; write for example cushion_law = \"combined\"",
    );
    after_head(
        "multi_contact = \"round\"\n",
        "4: physics.multi_contact = \"round\": this build knows \"rounds\", \"hertz\", \
         \"pairwise\"; did you mean \"rounds\"?",
    );
    after_head(
        "profile = 2009\n",
        "4: physics.profile = 2009: this build knows \"standard\", \"2009\"; did you mean \
         \"2009\"?",
    );
    after_head(
        "profile = \"2009\"\n",
        "4: physics.profile = \"2009\": \"2009\" is the paper's fixed step with its faults, and \
         event-driven has no steps; add solver = \"fixed-step\", or write profile = \"standard\"",
    );
    after_head(
        "[table]\n",
        "4: table.preset: missing, a table needs a preset; write preset = \"pool-9ft\", or use \
         [[plane]], [[box]] and [[mesh]] instead",
    );
    after_head(
        "[table]\npreset = \"bagatelle\"\n",
        "5: table.preset = \"bagatelle\": this build knows \"pool-9ft\", \"pool-8ft\", \
         \"pool-7ft\", \"snooker-12ft\", \"carom-10ft\"; write for example preset = \"pool-9ft\"",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\nlength_m = 3\n",
        "6: table.length_m = 3: table has the keys preset, room; remove this key",
    );
    after_head(
        "[[ball]]\nposition_m = [0, 0]\n",
        "4: ball[0].id: missing, every ball has a number; write for example id = 1; the cue ball \
         is 0",
    );
    after_head(
        "[[ball]]\nid = 1\n",
        "4: ball[0].position_m: missing, a ball has a place (m); write for example position_m = \
         [0, 0]",
    );
    after_head(
        "[[ball]]\nid = 70000\nposition_m = [0, 0]\n",
        "5: ball[0].id = 70000: expected a whole number from 0 to 65535; write for example id = 0",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nmass_kg = -0.17\n",
        "7: ball[0].mass_kg = -0.17: expected a number from 0.000001 to 1000000 (kg); write for \
         example mass_kg = 0.17",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nradius_m = 0\n",
        "7: ball[0].radius_m = 0: expected a number from 0.0001 to 10 (m); write for example \
         radius_m = 0.028575",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nradius_mm = 28\n",
        "7: ball[0].radius_mm = 28: ball[0] has the keys id, radius_m, mass_kg, inertia_factor, \
         position_m, velocity_m_s, angular_velocity_rad_s, flags, spring; did you mean radius_m?",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nvelocity_m_s = [1, 2]\n",
        "7: ball[0].velocity_m_s = [1, 2]: expected a list of 3 numbers from -100 to 100 (m/s); \
         write for example velocity_m_s = [0.0, 0.0, 0.0]",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nvelocity_m_s = [1, 2, nan]\n",
        "7: ball[0].velocity_m_s[2] = nan: expected a number from -100 to 100 (m/s); write for \
         example velocity_m_s = [0.0, 0.0, 0.0]",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nvelocity_m_s = 3\n",
        "7: ball[0].velocity_m_s = 3: expected a list of 3 numbers from -100 to 100 (m/s); write \
         for example velocity_m_s = [0.0, 0.0, 0.0]",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nvelocity_m_s = [1, 2, \"3\"]\n",
        "7: ball[0].velocity_m_s[2] = \"3\": expected a number from -100 to 100 (m/s); write for \
         example velocity_m_s = [0.0, 0.0, 0.0]",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nflags = { gravty = true }\n",
        "7: ball[0].flags.gravty = true: ball[0].flags has the keys gravity, integrate, collide; \
         did you mean gravity?",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nflags = true\n",
        "7: ball[0].flags = true: must be a table of keys; write flags = { .. } with its keys \
         inside",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nspring = { stiffness_n_m = -1 }\n",
        "7: ball[0].spring.stiffness_n_m = -1: expected a number from 0 to 10000000 (N/m); write \
         for example stiffness_n_m = 100.0",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\nspring = { anchor_orientation = [0, 0, 0, 0] }\n",
        "7: ball[0].spring.anchor_orientation = [0, 0, 0, 0]: expected a unit quaternion x, y, \
         z, w; write for example anchor_orientation = [0, 0, 0, 1]",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\n[[ball]]\nid = 1\nposition_m = [0, 0]\n",
        "8: ball[1].id = 1: another ball has this number already; give each ball a number of its \
         own",
    );
    after_head(
        "[[ball]]\nid = 1\nposition_m = [0, 0]\n[[ball]]\nid = 2\nposition_m = [0.05, 0]\n",
        "9: ball[1].position_m = [0.05, 0]: overlaps ball 1 by 0.0071 m: centres at least \
         0.057150 m apart; move one of the two",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[[ball]]\nid = 1\nposition_m = [1.26, 0]\n",
        "8: ball[0].position_m = [1.26, 0]: outside the bed: x from -1.2414 to 1.2414, y from \
         -0.6064 to 0.6064; move the ball onto the bed",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[[ball]]\nid = 1\nposition_m = [0, 0, 0.02]\n",
        "8: ball[0].position_m = [0, 0, 0.02]: under the cloth: a height of at least 0.028575; \
         leave the height out to put the ball on the bed",
    );
    after_head(
        "[[plane]]\nnormal = [0, 0, 1]\n[[ball]]\nid = 1\nposition_m = [0, 0, 0.01]\n",
        "8: ball[0].position_m = [0, 0, 0.01]: in plane[0]: at least its radius away, on the \
         free side; move the ball, or turn the plane's normal round",
    );
    after_head(
        "[[box]]\ncentre_m = [0, 0, 0]\nsize_m = [1, 1, 1]\n[[ball]]\nid = 1\nposition_m = [0, \
         0]\n",
        "9: ball[0].position_m = [0, 0]: in box[0]: at least its radius away from it; move the \
         ball or the box",
    );
    after_head(
        "[[plane]]\nnormal = [0, 0, 0]\n",
        "5: plane[0].normal = [0, 0, 0]: expected a vector that is not zero, towards the free \
         side; write for example normal = [0, 0, 1]",
    );
    after_head(
        "[[box]]\nsize_m = [1, 1, 1]\n",
        "4: box[0].centre_m: missing, a box has a middle (m); write for example centre_m = [0, \
         0, 0.05]",
    );
    after_head(
        "[[box]]\ncentre_m = [0, 0, 0]\nsize_m = [1, -1, 1]\n",
        "6: box[0].size_m[1] = -1: expected a number from 0.0001 to 1000 (m); write for example \
         size_m = [0.1, 0.1, 0.1]",
    );
    after_head(
        "[[mesh]]\n",
        "4: mesh[0].file: missing, a mesh is read from a Wavefront OBJ file; write for example \
         file = \"course.obj\"",
    );
    after_head(
        "[[mesh]]\nfile = \"a.obj\"\nsurface = \"ice\"\n",
        "6: mesh[0].surface = \"ice\": this build knows \"obstacle\", \"cloth\", \"wood\", \
         \"floor\"; write for example surface = \"obstacle\"",
    );
    after_head(
        "[[mesh]]\nfile = \"a.obj\"\nscale = 0\n",
        "6: mesh[0].scale = 0: expected a number from 0.000001 to 1000000; write for example \
         scale = 1.0",
    );
    after_head(
        "[balls]\nrack = \"eight-ball\"\n",
        "4: balls: a rack stands on a table; write [table] and preset = \"pool-9ft\", or list \
         each ball as [[ball]]",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[balls]\n",
        "6: balls.rack: missing, [balls] sets up a rack; write for example rack = \
         \"eight-ball\", or list each ball as [[ball]]",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \"bagatelle\"\n",
        "7: balls.rack = \"bagatelle\": this build knows \"eight-ball\", \"nine-ball\", \
         \"snooker\", \"carom\"; write for example rack = \"eight-ball\"",
    );
    after_head(
        "[rules]\ngame = \"bridge\"\n",
        &format!(
            "5: rules.game = \"bridge\": this build knows {}; write for example game = \
             \"paper-eight-ball\"",
            GameKind::ALL.map(|game| format!("{:?}", game.id())).join(", ")
        ),
    );
    for (game, rack) in [("wpa-nine-ball", "nine-ball"), ("straight", "eight-ball")] {
        let other = if rack == "nine-ball" { "eight-ball" } else { "nine-ball" };
        let two = "[[player]]\nname = \"A\"\nkind = \"paper\"\n[[player]]\nname = \"B\"\nkind = \
                   \"paper\"\n";
        let with = |rack: &str, players: &str| {
            format!(
                "[table]\npreset = \"pool-9ft\"\n[cue]\n[rules]\ngame = {game:?}\n[balls]\nrack = \
                 {rack:?}\n{players}"
            )
        };
        let wrong = format!(
            "8: rules.game = {game:?}: {game} begins with its rack; write [balls] and rack = \
             {rack:?}"
        );
        after_head(&with(other, two), &wrong);
        let wrong =
            format!("8: rules.game = {game:?}: {game} has two players; write a second [[player]]");
        after_head(&with(rack, &two[..37]), &wrong);
    }
    after_head(
        "[rules]\ngame = \"free-play\"\n",
        "5: rules.game = \"free-play\": rules need players; write [[player]] and kind = \"paper\"",
    );
    after_head(
        "[cue]\n[[player]]\nname = \"A\"\nkind = \"paper\"\n",
        "5: player: players need rules; write [rules] and game = \"free-play\", or remove the \
         players",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[cue]\n[balls]\nrack = \"eight-ball\"\n[rules]\ngame = \
         \"paper-eight-ball\"\n[[player]]\nname = \"A\"\nkind = \"paper\"\n",
        "10: rules.game = \"paper-eight-ball\": paper-eight-ball has two players; write a second \
         [[player]]",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[cue]\n[rules]\ngame = \
         \"paper-eight-ball\"\n[[player]]\nname = \"A\"\nkind = \"paper\"\n",
        "8: rules.game = \"paper-eight-ball\": rules need a cue ball, which has the number 0; \
         write [[ball]] and id = 0",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \"eight-ball\"\n[rules]\ngame = \
         \"free-play\"\n[[player]]\nname = \"A\"\nkind = \"paper\"\n",
        "12: player[0].kind = \"paper\": a player needs a cue; write a section [cue]",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[cue]\n[rules]\ngame = \"free-play\"\n[[player]]\nname \
         = \"A\"\nkind = \"paper\"\n",
        "8: rules.game = \"free-play\": rules need a cue ball, which has the number 0; write \
         [[ball]] and id = 0",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \"eight-ball\"\n[cue]\n[rules]\ngame = \
         \"free-play\"\n[[player]]\nkind = \"human\"\n",
        "12: player[0].kind = \"human\": such a player needs an input; write a section [input], \
         or [haptic] for a stylus",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \
         \"eight-ball\"\n[cue]\n[input]\n[rules]\ngame = \"free-play\"\n[[player]]\nkind = \
         \"recorded\"\n",
        "13: player[0].kind = \"recorded\": such a player needs a recording; write [actors] and \
         input = \"recorded:FILE\"",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \"eight-ball\"\n[cue]\n[rules]\ngame = \
         \"paper-eight-ball\"\n[[player]]\nname = \"A\"\nkind = \"paper\"\n[[player]]\nname = \
         \"B\"\nkind = \"paper\"\n[[player]]\nname = \"C\"\nkind = \"paper\"\n",
        "17: player[2]: at most 2 entries of player are allowed; remove 1",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \"eight-ball\"\n[cue]\n[rules]\ngame = \
         \"paper-eight-ball\"\n[[player]]\nname = \"A\"\nkind = \"paper\"\n[[player]]\nname = \
         \"A\"\nkind = \"paper\"\n",
        "15: player[1].name = \"A\": another player has this name already; write for example \
         name = \"Second\"",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[balls]\nrack = \
         \"eight-ball\"\n[cue]\n[input]\n[rules]\ngame = \"free-play\"\n[[player]]\nkind = \
         \"human\"\nnoise = 1\n",
        "14: player[0].noise = 1: only a computer player has it; remove noise, or write kind = \
         \"paper\"",
    );
    after_head(
        "[[player]]\nname = \"A\"\n",
        "4: player[0].kind: missing, a player is human, paper, club, champion, computer or \
         recorded; write for example kind = \"human\"",
    );
    after_head(
        "[[player]]\nkind = \"novice\"\n",
        "5: player[0].kind = \"novice\": this build knows \"human\", \"paper\", \"club\", \
         \"champion\", \"computer\", \"recorded\"; write for example kind = \"human\"",
    );
    after_head(
        "[[player]]\nkind = \"club\"\nstrength = 70\n",
        "6: player[0].strength = 70: only kind = \"computer\" has it; remove strength, or write \
         kind = \"computer\"",
    );
    after_head(
        "[[player]]\nkind = \"computer\"\nstrength = 101\n",
        "6: player[0].strength = 101: expected a whole number from 0 to 100; write for example \
         strength = 0",
    );
    after_head(
        "[[player]]\nkind = \"champion\"\nthrow_factor = 0.1\n",
        "6: player[0].throw_factor = 0.1: only the paper's player has it; remove throw_factor, or \
         write kind = \"paper\"",
    );
    after_head(
        "[[player]]\nkind = \"paper\"\nsimulations = 10\n",
        "6: player[0].simulations = 10: only a computer player that simulates has it; remove \
         simulations, or write kind = \"club\"",
    );
    after_head(
        "[[player]]\nkind = \"club\"\nsimulations = 0\n",
        "6: player[0].simulations = 0: expected a whole number from 1 to 1000000; write for \
         example simulations = 1",
    );
    after_head("[camera]\nfov = 0.5\n", "5: camera.fov = 0.5: camera has no keys; remove this key");
    after_head(
        "[cue]\nmass_kg = -1\n",
        "5: cue.mass_kg = -1: expected a number from 0.001 to 100 (kg); write for example mass_kg \
         = 0.54",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[cue]\nmass_kg = 0.35\n[balls]\nrack = \
         \"eight-ball\"\n[rules]\ngame = \"free-play\"\n[[player]]\nkind = \"paper\"\n",
        "13: player[0].kind = \"paper\": a computer player knows only a pool cue; remove the keys \
         of [cue], or write kind = \"human\"",
    );
    after_head("[renderer]\n", "4: renderer: a window needs a camera; write a section [camera]");
    after_head(
        "[camera]\n[renderer]\nwidth = 20\n",
        "6: renderer.width = 20: expected a whole number from 64 to 16384; write for example \
         width = 64",
    );
    after_head(
        "[input]\nprofile = \"left-handed\"\n",
        "5: input.profile = \"left-handed\": this build knows only \"default\"; write for \
         example profile = \"default\"",
    );
    after_head(
        "[actors]\ninput = \"replay\"\n",
        "5: actors.input = \"replay\": expected \"real\" or \"recorded:FILE\"; write for example \
         input = \"recorded:game.jsonl\"",
    );
    after_head(
        "[actors]\ninput = \"recorded:a.jsonl\"\n",
        "5: actors.input = \"recorded:a.jsonl\": there is no input to stand in for; write a \
         section [input]",
    );
    after_head(
        "[actors]\nrules = \"mock\"\n",
        "5: actors.rules = \"mock\": actors has the keys input; remove this key",
    );
    after_head(
        "[table]\npreset = \"pool-9ft\"\n[cue]\n[input]\n[rules]\ngame = \
         \"paper-eight-ball\"\n[[player]]\nname = \"A\"\nkind = \"human\"\n[balls]\nrack = \
         \"nine-ball\"\n",
        "9: rules.game = \"paper-eight-ball\": paper-eight-ball begins with its rack; write \
         [balls] and rack = \"eight-ball\"",
    );
}

#[test]
fn absurd_sizes_are_refused() {
    let long = format!("[scene]\nname = \"{}\"\n[physics]\n", "x".repeat(4097));
    let error = Scene::parse("s.toml", &long).unwrap_err().to_string();
    assert!(error.starts_with("s.toml:2: scene.name = \"xxx"), "{error}");
    assert!(error.ends_with("write for example name = \"My scene\""), "{error}");
    assert!(error.len() < 300, "{error}");

    let ball = |i: usize| format!("[[ball]]\nid = {i}\nposition_m = [{}, 0]\n", i as f64 * 0.06);
    let balls = |n: usize| HEAD.to_string() + &(0..n).map(ball).collect::<String>();
    assert_eq!(Scene::parse("s.toml", &balls(4096)).unwrap().ball[4095].id, BallId(4095));
    whole(&balls(4098), "12292: ball[4096]: at most 4096 entries of ball are allowed; remove 2");

    let meshes = HEAD.to_string() + &"[[mesh]]\nfile = \"a.obj\"\n".repeat(65);
    whole(&meshes, "132: mesh[64]: at most 64 entries of mesh are allowed; remove 1");

    whole(
        &"#".repeat(FILE_BYTES_MAX + 1),
        "1: size = 4194305 bytes: a scene has at most 4194304 bytes; move large meshes to files \
         of their own",
    );
}

#[test]
fn an_error_has_one_line_even_if_names_have_several() {
    let text = "[scene]\n\"na\\nme\" = \"\"\"a\nb\"\"\"\n[physics]\n";
    let error = Scene::parse("my\nfile.toml", text).unwrap_err().to_string();
    assert_eq!(
        error,
        "my file.toml:2: scene.na me = \"\"\"a b\"\"\": scene has the keys name, \
         description, seed; did you mean name?"
    );
}
