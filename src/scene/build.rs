//! Makes the table and the balls that a scene names.

use super::{BallId, PlayerId};
use super::{BallSection, BoxSection, RackKind, Scene, SceneError, TOUCHING_M};
use crate::ball::{Ball, BallPlace, BallState, Motion};
use crate::ids::GameKind;
use crate::mesh::{Face, Mesh, parse_obj};
use crate::physics::{Equipment, Parameters, Racks};
use crate::rack::{Rack, Spots};
use crate::room::Room;
use crate::table::Table;
use glam::{DQuat, DVec3};

/// How far from the origin a mesh may reach, along each axis [m].
const MESH_REACH_M: f64 = 1e4;

impl Scene {
    /// The ground that the scene names. `load` hands over the text of each mesh file that
    /// [`Scene::meshes_needed`] lists, or says why it cannot.
    pub fn build_table(
        &self,
        load: &mut dyn FnMut(&str) -> Result<String, String>,
    ) -> Result<Table, SceneError> {
        let mut table = match &self.table {
            Some(section) => Table::preset(&section.preset).map_err(|error| {
                let (found, fix) = (&section.preset, "write preset = \"pool-9ft\"");
                self.error(section.line, "table.preset", found, &error.to_string(), fix)
            })?,
            None => Table { name: self.about.name.clone(), ..Table::default() },
        };
        table.spots = match self.equipment() {
            Equipment::Pool => Spots::Foot,
            Equipment::Snooker => Spots::Snooker,
            Equipment::Carom => Spots::Carom,
        };
        if self.table.as_ref().is_some_and(|section| section.room)
            && let Some(room) = Room::around(&table)
        {
            table.mesh.append(&room.collision());
        }
        table.planes.extend_from_slice(&self.planes);
        for section in &self.boxes {
            table.mesh.append(&box_mesh(section));
        }
        for (i, section) in self.meshes.iter().enumerate() {
            let wrong = |problem: &str, fix: &str| {
                self.error(section.line, &format!("mesh[{i}].file"), &section.file, problem, fix)
            };
            let text = load(&section.file)
                .map_err(|problem| wrong(&problem, "put the mesh file beside the scene"))?;
            let mut mesh = parse_obj(&text, section.surface)
                .map_err(|error| wrong(&error.to_string(), "correct the mesh file"))?;
            for vertex in &mut mesh.vertices {
                *vertex = *vertex * section.scale + section.offset_m;
            }
            let is_far = |vertex: &&DVec3| !(vertex.abs().max_element() <= MESH_REACH_M);
            if let Some(vertex) = mesh.vertices.iter().find(is_far) {
                let problem = format!("a corner at {vertex} m: at most {MESH_REACH_M} m away");
                return Err(wrong(&problem, "correct the mesh file, or the scale of the mesh"));
            }
            table.mesh.append(&mesh);
        }
        Ok(table)
    }

    /// The balls on `table` when the scene begins, in ascending order of id: the rack, and over it
    /// each [[ball]].
    pub fn build_balls(&self, table: &Table) -> Result<Vec<(Ball, BallState)>, SceneError> {
        let mut balls = Vec::new();
        if let Some(section) = &self.balls {
            balls = self.rack(section.rack).place(table).map_err(|error| {
                let (found, fix) = (section.rack.name(), "write [table] and preset = \"pool-9ft\"");
                self.error(section.line, "balls.rack", found, &error.to_string(), fix)
            })?;
            balls.retain(|(ball, _)| self.ball.iter().all(|section| section.id != ball.id));
        }
        let racked = balls.len();
        balls.extend(self.ball.iter().map(BallSection::placed));
        for (i, section) in self.ball.iter().enumerate().filter(|(_, one)| one.flags.collide) {
            let wrong = |problem: &str, fix: &str| {
                let found = format!("{:?}", section.position_m.to_array());
                let key = format!("ball[{i}].position_m");
                SceneError::new(&self.file, section.line, &key, Some(&found), problem, fix)
            };
            let centre = section.position_m;
            let under = |(ball, state): &&(Ball, BallState)| {
                let apart = ball.radius_m + section.radius_m - TOUCHING_M;
                state.position.distance(centre) < apart
            };
            if let Some((ball, _)) = balls[..racked].iter().find(under) {
                let problem = format!("overlaps ball {} of the rack", ball.id);
                return Err(wrong(&problem, "move it, or give it the number of that ball"));
            }
            let pierced = |face: &usize| {
                let reach = section.radius_m - TOUCHING_M;
                distance_to_triangle(centre, table.mesh.corners(*face), reach) < reach
            };
            // The parser has held the ball against table, planes and boxes already.
            if !self.meshes.is_empty() && (0..table.mesh.faces.len()).any(|face| pierced(&face)) {
                let problem = "in a mesh: at least its radius away from every face";
                return Err(wrong(problem, "move the ball, or set offset_m of the mesh"));
            }
        }
        balls.sort_by_key(|(ball, _)| ball.id);
        Ok(balls)
    }

    /// How the scene's balls are racked, as often as its rules ask for it.
    pub fn racks(&self, table: &Table) -> Racks {
        let apart: Vec<_> = self.ball.iter().map(BallSection::placed).collect();
        let rack = match &self.balls {
            Some(section) => self.rack(section.rack),
            None => Rack::from_balls(Vec::new()),
        };
        Racks::new(rack, apart, table)
    }

    fn rack(&self, kind: RackKind) -> Rack {
        let seed = self.about.seed;
        match kind {
            RackKind::EightBall => Rack::eight_ball(seed),
            RackKind::NineBall => Rack::nine_ball(seed),
            RackKind::Snooker => Rack::snooker(seed),
            // Each player has a ball of his own: who breaks decides which stands beside.
            RackKind::Carom => Rack::carom(match self.rules.map(|rules| rules.first_player) {
                Some(PlayerId::TWO) => BallId(1),
                _ => BallId::CUE,
            }),
        }
    }

    /// What the scene's rack is played with; pool's without one.
    pub fn equipment(&self) -> Equipment {
        self.balls.as_ref().map_or(Equipment::Pool, |balls| balls.rack.equipment())
    }

    /// The numbers of the contact laws, with those of the scene's own cue.
    pub fn parameters(&self) -> Parameters {
        let mut parameters = Parameters::with_equipment(&self.physics, self.equipment());
        if let Some(cue) = &self.cue {
            cue.apply(&mut parameters);
        }
        parameters
    }

    /// Why this scene is none of a game, and what helps; none if it is one.
    pub fn misfit(&self, game: GameKind) -> Option<(String, String)> {
        super::check::misfit(self, game)
    }

    /// Whether somebody sits at mouse and keyboard, and nothing stands in.
    pub fn has_hand(&self) -> bool {
        let stands_in = self.actors.as_ref().is_some_and(|actors| actors.input.is_some());
        self.input.is_some() && !stands_in
    }

    /// Whether whoever holds the stylus of a haptic device is at the table with nobody's mouse
    /// beside it: alone with the balls, or in their turns.
    pub fn is_led(&self) -> bool {
        !self.has_hand() && (self.players.is_empty() || !self.human_players().is_empty())
    }

    /// The players whose commands come from the input: at a mouse, or from a recording.
    pub fn human_players(&self) -> Vec<PlayerId> {
        let ids = [PlayerId::ONE, PlayerId::TWO];
        let at_input = self.players.iter().zip(ids);
        at_input.filter(|(player, _)| !player.kind.is_computer()).map(|(_, id)| id).collect()
    }

    /// An error about what stands on `line`.
    fn error(&self, line: usize, key: &str, found: &str, allowed: &str, fix: &str) -> SceneError {
        SceneError::new(&self.file, line, key, Some(&format!("{found:?}")), allowed, fix)
    }
}

impl BallSection {
    /// The ball and its state when the scene begins.
    fn placed(&self) -> (Ball, BallState) {
        let still = self.velocity_m_s == DVec3::ZERO && self.angular_velocity_rad_s == DVec3::ZERO;
        let state = BallState {
            id: self.id,
            position: self.position_m,
            velocity: self.velocity_m_s,
            angular_velocity: self.angular_velocity_rad_s,
            orientation: DQuat::IDENTITY,
            // Physics finds out at its first step what carries a ball that moves.
            motion: if still { Motion::Rest } else { Motion::Sliding },
            place: BallPlace::OnTable,
        };
        (self.ball(), state)
    }
}

/// The twelve faces of a box, anticlockwise seen from outside.
fn box_mesh(section: &BoxSection) -> Mesh {
    // Corner k is at the far end along x, y, z where bits 0, 1, 2 of k are set.
    let corner = |k: u8| {
        let sign = |bit: u8| if k >> bit & 1 == 1 { 0.5 } else { -0.5 };
        section.centre_m + section.size_m * DVec3::new(sign(0), sign(1), sign(2))
    };
    const SIDES: [[u32; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    let face = |corners| Face { corners, surface: section.surface };
    Mesh {
        vertices: (0..8).map(corner).collect(),
        faces: SIDES.into_iter().flat_map(halves).map(face).collect(),
    }
}

/// Distance from `point` to a triangle [m]; at least `reach` if its box alone is farther away.
fn distance_to_triangle(point: DVec3, [a, b, c]: [DVec3; 3], reach: f64) -> f64 {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let to_box = (point.clamp(low, high) - point).length();
    if to_box >= reach {
        return to_box;
    }
    // Over the face itself if the foot of the perpendicular lies inside all three sides.
    let normal = (b - a).cross(c - a);
    let inside = [(a, b), (b, c), (c, a)]
        .into_iter()
        .all(|(from, to)| (to - from).cross(point - from).dot(normal) >= 0.0);
    if inside && normal != DVec3::ZERO {
        return (point - a).dot(normal).abs() / normal.length();
    }
    // Else the nearest of the three sides.
    let to_side = |(from, to): (DVec3, DVec3)| {
        let side = to - from;
        let along = (point - from).dot(side) / side.length_squared();
        // A side without length is its corner.
        let along = if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 };
        point.distance(from + along * side)
    };
    to_side((a, b)).min(to_side((b, c))).min(to_side((c, a)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Surface;

    #[test]
    fn a_box_is_closed_and_its_faces_look_outwards() {
        let (centre_m, size_m) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.2, 0.4, 0.6));
        let mesh = box_mesh(&BoxSection { centre_m, size_m, surface: Surface::Wood });
        assert_eq!((mesh.vertices.len(), mesh.faces.len()), (8, 12));
        let volume = |face| {
            let [a, b, c] = mesh.corners(face).map(|corner| corner - centre_m);
            a.dot(b.cross(c)) / 6.0
        };
        let volumes: Vec<f64> = (0..12).map(volume).collect();
        // Each face spans a twelfth of the box with its middle; a face that looked inwards would
        // count negative.
        let expected = 0.2 * 0.4 * 0.6 / 12.0;
        assert!(volumes.iter().all(|v| (v - expected).abs() < 1e-12), "{volumes:?}");
    }

    #[test]
    fn distances_to_a_triangle_are_those_to_face_side_and_corner() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let distance = |x, y, z| distance_to_triangle(DVec3::new(x, y, z), triangle, f64::MAX);
        assert_eq!(distance(0.2, 0.2, 0.5), 0.5);
        assert_eq!(distance(0.2, 0.2, -0.5), 0.5);
        assert_eq!(distance(0.5, -2.0, 0.0), 2.0);
        assert!((distance(1.0, 1.0, 0.0) - 0.5f64.sqrt()).abs() < 1e-15);
        assert_eq!(distance(4.0, 0.0, 4.0), 5.0);
        let point = [DVec3::X; 3];
        assert_eq!(distance_to_triangle(DVec3::ZERO, point, 9.0), 1.0);
    }
}
