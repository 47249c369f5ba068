//! Wavefront OBJ, from text: the lines `v` and `f`, and materials that have the name of a surface;
//! everything that only concerns display is passed over.

use super::{Face, Mesh, Surface};
use crate::ids::PocketId;
use glam::DVec3;

/// Most vertices, and most triangles, that are accepted from one text.
pub const OBJ_COUNT_MAX: usize = 2_000_000;

/// What was wrong with an OBJ text.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ObjError {
    /// A line could not be understood.
    #[error("line {line}: {problem}")]
    Line {
        /// Line number from 1.
        line: usize,
        /// What is wrong with it: what was found and what was expected.
        problem: String,
    },
    /// There are too many vertices or triangles.
    #[error("line {line}: more than {OBJ_COUNT_MAX} {what}; simplify the mesh")]
    TooMany {
        /// Line number from 1.
        line: usize,
        /// Vertices or triangles.
        what: &'static str,
    },
    /// Nothing to touch.
    #[error("the mesh has no faces; at least one line 'f' with three corners was expected")]
    NoFaces,
}

/// The surfaces that a material's name chooses.
///
/// A course has one hole at most, and to the rules it is the pocket at the foot, left.
const SURFACES: [(&str, Surface); 6] = [
    ("cloth", Surface::Cloth),
    ("wood", Surface::Wood),
    ("floor", Surface::Floor),
    ("obstacle", Surface::Obstacle),
    ("pocket", Surface::Pocket(PocketId::Fl)),
    ("hole", Surface::PocketBottom(PocketId::Fl)),
];

/// Reads a mesh; every face gets `surface`, unless its material has the name of another: `cloth`,
/// `wood`, `floor`, `obstacle`, `pocket` (the wall of a hole) or `hole` (its bottom: a ball that
/// touches it is down).
///
/// Polygons become fans of triangles round their first corner. Corners may be written `i`, `i/t`,
/// `i/t/n` or `i//n`, and count from 1, or backwards from −1. Groups, other materials, normals and
/// texture coordinates are ignored; other keywords are errors.
pub fn parse_obj(text: &str, surface: Surface) -> Result<Mesh, ObjError> {
    let mut mesh = Mesh::default();
    let mut made = surface;
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let content = content.split('#').next().unwrap_or_default();
        let mut words = content.split_whitespace();
        match words.next() {
            Some("v") => {
                if mesh.vertices.len() >= OBJ_COUNT_MAX {
                    return Err(ObjError::TooMany { line, what: "vertices" });
                }
                mesh.vertices.push(vertex(words, line)?);
            }
            Some("f") => face(&mut mesh, words, made, line)?,
            Some("usemtl") => {
                let name = words.next().unwrap_or_default();
                let known = SURFACES.iter().find(|(known, _)| *known == name);
                made = known.map_or(surface, |(_, surface)| *surface);
            }
            Some("vn" | "vt" | "vp" | "o" | "g" | "s" | "mtllib" | "l" | "p") | None => {}
            Some(other) => {
                return Err(problem(
                    line,
                    format!(
                        "found '{}'; expected v, f, vn, vt, o, g, s, usemtl or mtllib",
                        short(other)
                    ),
                ));
            }
        }
    }
    if mesh.faces.is_empty() { Err(ObjError::NoFaces) } else { Ok(mesh) }
}

fn problem(line: usize, problem: String) -> ObjError {
    ObjError::Line { line, problem }
}

/// The beginning of a word, so that a hostile line neither fills the screen nor breaks it.
fn short(word: &str) -> String {
    word.chars().take(40).map(|c| if c.is_control() { '?' } else { c }).collect()
}

/// Three coordinates; a fourth (the weight) or three colours after them are passed over.
fn vertex<'a>(words: impl Iterator<Item = &'a str>, line: usize) -> Result<DVec3, ObjError> {
    let mut coordinates = [0.0; 3];
    let mut found = 0;
    for (slot, word) in coordinates.iter_mut().zip(words) {
        *slot = match word.parse::<f64>() {
            Ok(value) if value.is_finite() => value,
            _ => {
                let text = format!("found coordinate '{}'; expected a finite number", short(word));
                return Err(problem(line, text));
            }
        };
        found += 1;
    }
    if found < 3 {
        return Err(problem(line, format!("found {found} coordinates; expected 3")));
    }
    Ok(DVec3::from_array(coordinates))
}

fn face<'a>(
    mesh: &mut Mesh,
    words: impl Iterator<Item = &'a str>,
    surface: Surface,
    line: usize,
) -> Result<(), ObjError> {
    let (mut first, mut previous, mut found) = (None, None, 0);
    for word in words {
        let corner = corner(word, mesh.vertices.len(), line)?;
        found += 1;
        match (first, previous) {
            (Some(a), Some(b)) => {
                if mesh.faces.len() >= OBJ_COUNT_MAX {
                    return Err(ObjError::TooMany { line, what: "triangles" });
                }
                mesh.faces.push(Face { corners: [a, b, corner], surface });
                previous = Some(corner);
            }
            (Some(_), None) => previous = Some(corner),
            (None, _) => first = Some(corner),
        }
    }
    if found < 3 {
        return Err(problem(line, format!("found a face of {found} corners; expected at least 3")));
    }
    Ok(())
}

/// The vertex number of a corner, from 0.
fn corner(word: &str, vertices: usize, line: usize) -> Result<u32, ObjError> {
    let mut parts = word.split('/');
    let number = parts.next().and_then(|part| part.parse::<i64>().ok());
    let rest_is_sound = parts.clone().count() <= 2
        && parts.all(|part| part.is_empty() || part.parse::<i64>().is_ok());
    let Some(number) = number.filter(|_| rest_is_sound) else {
        let text = format!("found corner '{}'; expected i, i/t, i/t/n or i//n", short(word));
        return Err(problem(line, text));
    };
    let index = if number < 0 { number.saturating_add(vertices as i64) } else { number - 1 };
    if 0 <= index && index < vertices as i64 {
        return Ok(index as u32);
    }
    let expected = match vertices {
        0 => "a vertex line before the face".to_owned(),
        _ => format!("1 to {vertices} or -{vertices} to -1, the vertices so far"),
    };
    Err(problem(line, format!("found vertex number {number}; expected {expected}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(text: &str) -> Vec<[u32; 3]> {
        let mesh = parse_obj(text, Surface::Obstacle).unwrap();
        mesh.faces.iter().map(|face| face.corners).collect()
    }

    #[track_caller]
    fn check_error(text: &str, expected: &str) {
        let error = parse_obj(text, Surface::Obstacle).unwrap_err().to_string();
        assert!(error.contains(expected), "'{error}' does not contain '{expected}'");
    }

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    #[test]
    fn all_forms_of_corners_are_read() {
        let text = format!("# a square\nmtllib x.mtl\no a\n{SQUARE}vn 0 0 1\nvt 0 0\ns off\n");
        for face in ["f 1 2 3 4", "f 1/1 2/1 3/1 4/1", "f 1/1/1 2/1/1 3/1/1 4/1/1"] {
            assert_eq!(corners(&format!("{text}{face}")), [[0, 1, 2], [0, 2, 3]]);
        }
        assert_eq!(corners(&format!("{text}f 1//1 2//1 3//1 # half\r\n")), [[0, 1, 2]]);
        assert_eq!(corners(&format!("{text}f -4 -3 -1")), [[0, 1, 3]]);
    }

    #[test]
    fn coordinates_are_exact_and_weights_pass() {
        let mesh = parse_obj("v 0.1 -2e-3 3 1\nv 1 0 0\nv 0 1 0\nf 1 2 3", Surface::Wood).unwrap();
        assert_eq!(mesh.vertices[0], DVec3::new(0.1, -2e-3, 3.0));
        assert_eq!(mesh.faces[0].surface, Surface::Wood);
    }

    #[test]
    fn materials_with_the_name_of_a_surface_choose_it() {
        let text = format!("{SQUARE}f 1 2 3\nusemtl wood\nf 1 2 3 4\nusemtl Red\nf 1 2 3\n");
        let mesh = parse_obj(&text, Surface::Floor).unwrap();
        let surfaces: Vec<_> = mesh.faces.iter().map(|face| face.surface).collect();
        assert_eq!(surfaces, [Surface::Floor, Surface::Wood, Surface::Wood, Surface::Floor]);
        let hole = parse_obj(&format!("{SQUARE}usemtl hole\nf 1 2 3"), Surface::Cloth).unwrap();
        assert!(matches!(hole.faces[0].surface, Surface::PocketBottom(_)));
    }

    #[test]
    fn errors_name_line_finding_and_expectation() {
        check_error("v 0 x 0", "line 1: found coordinate 'x'; expected a finite number");
        check_error("\nv 0 NaN 0", "line 2: found coordinate 'NaN'");
        check_error("v 0 inf 0", "found coordinate 'inf'");
        check_error("v 0 0", "line 1: found 2 coordinates; expected 3");
        check_error(&format!("{SQUARE}f 1 2"), "line 5: found a face of 2 corners");
        check_error(&format!("{SQUARE}f 1 2 5"), "found vertex number 5; expected 1 to 4");
        check_error(&format!("{SQUARE}f 0 1 2"), "found vertex number 0");
        check_error(&format!("{SQUARE}f -5 1 2"), "found vertex number -5");
        check_error(&format!("{SQUARE}f 1 2 9223372036854775807"), "vertex number");
        check_error(&format!("{SQUARE}f -9223372036854775808 1 2"), "vertex number");
        check_error(&format!("{SQUARE}f 1 2 3/a"), "found corner '3/a'; expected i, i/t");
        check_error(&format!("{SQUARE}f 1 2 3/1/1/1"), "found corner");
        check_error("f 1 2 3", "expected a vertex line before the face");
        check_error("hello", "line 1: found 'hello'");
        check_error(SQUARE, "no faces");
        check_error("", "no faces");
    }

    #[test]
    fn too_many_vertices_are_refused() {
        let text = "v 0 0 0\n".repeat(OBJ_COUNT_MAX + 1);
        check_error(&text, "line 2000001: more than 2000000 vertices");
    }
}
