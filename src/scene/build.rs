//! Makes the table and the balls that a scene names.

use super::{BoxSection, Scene, SceneError};
use crate::ids::PlayerId;
use crate::mesh::{Face, Mesh, parse_obj};
use crate::scene::PlayerKind;
use crate::table::Table;
use glam::DVec3;

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
            table.mesh.append(&mesh);
        }
        Ok(table)
    }

    /// The players whose commands come from the input: at a mouse, or from a recording.
    pub fn human_players(&self) -> Vec<PlayerId> {
        let ids = [PlayerId::ONE, PlayerId::TWO];
        let at_input = self.players.iter().zip(ids);
        at_input.filter(|(player, _)| player.kind != PlayerKind::Paper).map(|(_, id)| id).collect()
    }

    /// An error about what stands on `line`.
    fn error(&self, line: usize, key: &str, found: &str, allowed: &str, fix: &str) -> SceneError {
        SceneError::new(&self.file, line, key, Some(&format!("{found:?}")), allowed, fix)
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
}
