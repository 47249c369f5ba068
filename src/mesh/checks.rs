//! What can be said about a mesh as a whole.

use super::Mesh;
use glam::DVec3;

impl Mesh {
    /// Edges that are not shared by exactly two faces in opposite directions, as pairs of vertex
    /// numbers in the direction of a face, in order. A closed, consistently oriented mesh has none.
    pub fn open_edges(&self) -> Vec<(u32, u32)> {
        let mut edges: Vec<(u32, u32)> = Vec::with_capacity(3 * self.faces.len());
        for face in &self.faces {
            let [a, b, c] = face.corners;
            edges.extend([(a, b), (b, c), (c, a)]);
        }
        edges.sort_unstable();
        let uses = |edge: (u32, u32)| {
            let first = edges.partition_point(|other| *other < edge);
            edges[first..].iter().take_while(|other| **other == edge).count()
        };
        let runs = edges.chunk_by(|a, b| a == b);
        runs.filter(|run| {
            let (a, b) = run[0];
            a == b || run.len() != 1 || uses((b, a)) != 1
        })
        .map(|run| run[0])
        .collect()
    }

    /// Signed volume [m³]: Σ a · (b × c) / 6 over the faces (divergence theorem). Positive when
    /// the normals of a closed mesh point outward; meaningless for an open one.
    pub fn volume(&self) -> f64 {
        (0..self.faces.len())
            .map(|index| {
                let [a, b, c] = self.corners(index);
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }

    /// The least and the greatest coordinates of all vertices [m]; `None` without vertices.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let first = *self.vertices.first()?;
        Some(
            self.vertices
                .iter()
                .fold((first, first), |(low, high), vertex| (low.min(*vertex), high.max(*vertex))),
        )
    }
}

#[cfg(test)]
mod tests {
    use crate::mesh::{Face, Mesh, Surface};
    use glam::DVec3;

    fn tetrahedron() -> Mesh {
        let face = |corners| Face { corners, surface: Surface::Obstacle };
        Mesh {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            faces: vec![face([0, 2, 1]), face([0, 1, 3]), face([0, 3, 2]), face([1, 2, 3])],
        }
    }

    #[test]
    fn closed_tetrahedron_has_no_open_edge_and_a_sixth_of_volume() {
        let mesh = tetrahedron();
        assert_eq!(mesh.open_edges(), []);
        assert!((mesh.volume() - 1.0 / 6.0).abs() < 1e-15);
        assert_eq!(mesh.bounds(), Some((DVec3::ZERO, DVec3::ONE)));
    }

    #[test]
    fn missing_and_turned_faces_open_three_edges() {
        let mut mesh = tetrahedron();
        mesh.faces.pop();
        assert_eq!(mesh.open_edges().len(), 3);
        let mut mesh = tetrahedron();
        mesh.faces[3].corners.swap(0, 1);
        // All three edges run the same way in both faces.
        assert_eq!(mesh.open_edges().len(), 3);
        assert_eq!(Mesh::default().bounds(), None);
    }
}
