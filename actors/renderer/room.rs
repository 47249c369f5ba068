//! The room on the graphics card: four draw calls: the lamp, what mirrors, what does not, the
//! vault.

use super::materials::{Facts, program};
use super::room_light::{RoomLight, shipped_light};
use glam::DVec3;
use hapticbillard::room::{Grain, Group, LightMap, Room, TILE_SIDE, Vertex, lamp_opacity};
use hapticbillard::table::Table;
use std::sync::Arc;
use three_d::*;

const VERTEX: &str = include_str!("shaders/room.vert");
const FRAGMENT: &str = include_str!("shaders/room.frag");
/// Below this share nothing of the lamp is drawn, and above the other all of it.
const UNSEEN: f64 = 0.01;
/// See [`UNSEEN`].
const WHOLE: f64 = 0.99;
/// What mirrors less is drawn without: on a processor mirroring costs more than all the rest.
const GLOSS_LEAST: f32 = 0.35;
/// How bright what shines is on the screen at most: brighter colours would all be white.
const GLARE: f32 = 4.0;

/// The room round a table, made when it is first wanted.
pub struct RoomPlace {
    table: Arc<Table>,
    /// Nothing yet; then the room and its light, if there can be one.
    made: Option<Option<(RoomStage, RoomLight)>>,
    /// It is seen in this picture.
    is_shown: bool,
}

impl RoomPlace {
    /// That of a table.
    pub fn round(table: Arc<Table>) -> Self {
        RoomPlace { table, made: None, is_shown: false }
    }

    /// That table.
    pub fn table(&self) -> &Arc<Table> {
        &self.table
    }

    /// Whether this part of a table is drawn with the room.
    pub fn draws(part: &str) -> bool {
        matches!(part, "floor" | "apron" | "legs")
    }

    /// The next picture shows it, if that is wanted and there is one; whether it does.
    pub fn show(&mut self, is_wanted: bool, context: &Context) -> bool {
        let table = &self.table;
        self.is_shown = is_wanted
            && self.made.get_or_insert_with(|| RoomStage::around(context, table)).is_some();
        self.is_shown
    }

    /// Its light, where it is seen.
    pub fn light(&self) -> Option<&RoomLight> {
        self.seen().map(|(_, light)| light)
    }

    /// Draws it, where it is seen; `bed` is half the bed [m].
    pub fn draw(&self, bed: Vec2, camera: &Camera) {
        if let Some((stage, light)) = self.seen() {
            stage.draw(&Facts { bed, room: Some(light) }, camera);
        }
    }

    fn seen(&self) -> Option<&(RoomStage, RoomLight)> {
        self.made.as_ref()?.as_ref().filter(|_| self.is_shown)
    }
}

/// Meshes and textures of a room.
struct RoomStage {
    matt: Program,
    glossy: Program,
    fading: Program,
    positions: VertexBuffer<Vec3>,
    normals: VertexBuffer<Vec3>,
    paints: VertexBuffer<Vec4>,
    grains: VertexBuffer<Vec3>,
    lights: VertexBuffer<Vec2>,
    standing: ElementBuffer<u32>,
    mirroring: ElementBuffer<u32>,
    ceiling: ElementBuffer<u32>,
    lamp: ElementBuffer<u32>,
    tiles: Texture2DArray,
    crown_m: f64,
    outer: glam::DVec2,
}

impl RoomStage {
    /// The room of a table and its light, if it is a table that has one.
    fn around(context: &Context, table: &Table) -> Option<(Self, RoomLight)> {
        let room = Room::around(table)?;
        let map = shipped_light(&table.name, &room).unwrap_or_else(|reason| {
            tracing::warn!("no baked light for {}: {reason}; it is lit plainly", table.name);
            LightMap::unbaked(&room)
        });
        match Self::new(context, &room) {
            Ok(stage) => Some((stage, RoomLight::new(context, &room, &map))),
            Err(error) => {
                tracing::error!("the room is not drawn: {error}");
                None
            }
        }
    }

    fn new(context: &Context, room: &Room) -> Result<Self, CoreError> {
        let program = |gloss, fading| {
            let set = [("ROOM", 1), ("GLOSS", gloss), ("FADING", fading)];
            program(context, VERTEX, &set, &[FRAGMENT])
        };
        let surfaces = &room.surfaces;
        let mirrors = |corner: u32| {
            let finish = surfaces.finish_of(&surfaces.vertices[corner as usize]);
            GLOSS_LEAST <= finish.gloss || finish.shines()
        };
        // The upper side of the table is drawn by others.
        let mut numbers = vec![u32::MAX; surfaces.vertices.len()];
        let mut vertices: Vec<&Vertex> = Vec::new();
        let mut indices: [Vec<u32>; 4] = Default::default();
        for (corners, group) in &surfaces.triangles {
            let indices = match group {
                Group::Standing if mirrors(corners[0]) => &mut indices[1],
                Group::Standing => &mut indices[0],
                Group::Ceiling => &mut indices[2],
                Group::Lamp => &mut indices[3],
                Group::TableTop => continue,
            };
            for corner in corners {
                let number = &mut numbers[*corner as usize];
                if *number == u32::MAX {
                    *number = vertices.len() as u32;
                    vertices.push(&surfaces.vertices[*corner as usize]);
                }
                indices.push(*number);
            }
        }
        let vector = |v: DVec3| vec3(v.x as f32, v.y as f32, v.z as f32);
        let paint = |vertex: &&Vertex| {
            let finish = surfaces.finish_of(vertex);
            let brightest = finish.emission.into_iter().fold(0.0, f32::max);
            match finish.shines() {
                true => (Vec3::from(finish.emission) / brightest).extend(-brightest.min(GLARE)),
                false => Vec3::from(finish.colour).extend(finish.gloss),
            }
        };
        let grain = |vertex: &&Vertex| {
            let grain = surfaces.finish_of(vertex).grain;
            let [u, v] = grain.tile_m();
            let at = vertex.grain / glam::DVec2::new(u, v);
            vec3(at.x as f32, at.y as f32, grain.layer() as f32)
        };
        let [width, height] = surfaces.size.map(f64::from);
        let light = |vertex: &&Vertex| {
            vec2((vertex.light.x / width) as f32, (vertex.light.y / height) as f32)
        };
        let each = || vertices.iter();
        let positions: Vec<Vec3> = each().map(|vertex| vector(vertex.position)).collect();
        let normals: Vec<Vec3> = each().map(|vertex| vector(vertex.normal)).collect();
        let [standing, mirroring, ceiling, lamp] =
            indices.map(|indices| ElementBuffer::new_with_data(context, &indices));
        Ok(RoomStage {
            matt: program(0, 0)?,
            glossy: program(1, 0)?,
            fading: program(1, 1)?,
            positions: VertexBuffer::new_with_data(context, &positions),
            normals: VertexBuffer::new_with_data(context, &normals),
            paints: VertexBuffer::new_with_data(context, &each().map(paint).collect::<Vec<_>>()),
            grains: VertexBuffer::new_with_data(context, &each().map(grain).collect::<Vec<_>>()),
            lights: VertexBuffer::new_with_data(context, &each().map(light).collect::<Vec<_>>()),
            standing,
            mirroring,
            ceiling,
            lamp,
            tiles: tiles(context),
            crown_m: room.crown_m(),
            outer: room.outer,
        })
    }

    fn draw(&self, facts: &Facts, camera: &Camera) {
        let eye = camera.position();
        let own = DVec3::new(f64::from(eye.x), f64::from(eye.y), f64::from(eye.z));
        let opacity = lamp_opacity(own, self.outer);
        // What is near hides what is far, and the walls are farthest.
        if WHOLE < opacity {
            self.part(&self.glossy, &self.lamp, facts, camera);
        } else if UNSEEN < opacity {
            self.fading.use_uniform("seen", opacity as f32);
            self.part(&self.fading, &self.lamp, facts, camera);
        }
        self.part(&self.glossy, &self.mirroring, facts, camera);
        self.part(&self.matt, &self.standing, facts, camera);
        if own.z < self.crown_m {
            self.part(&self.matt, &self.ceiling, facts, camera);
        }
    }

    fn part(
        &self,
        program: &Program,
        indices: &ElementBuffer<u32>,
        facts: &Facts,
        camera: &Camera,
    ) {
        facts.tell(program, camera);
        program.use_texture_array("grains", &self.tiles);
        program.use_vertex_attribute("position", &self.positions);
        program.use_vertex_attribute("paint", &self.paints);
        program.use_vertex_attribute("grain", &self.grains);
        program.use_vertex_attribute("light", &self.lights);
        // A matt surface has no use for it.
        if program.requires_attribute("normal") {
            program.use_vertex_attribute("normal", &self.normals);
        }
        let states = RenderStates { cull: Cull::Back, ..RenderStates::default() };
        program.draw_elements(states, camera.viewport(), indices);
    }
}

/// The tiles of all grains.
fn tiles(context: &Context) -> Texture2DArray {
    let layers: Vec<CpuTexture> = Grain::ALL
        .iter()
        .map(|grain| CpuTexture {
            name: "grain".to_owned(),
            data: TextureData::RgbU8(grain.tile()),
            width: TILE_SIDE,
            height: TILE_SIDE,
            min_filter: Interpolation::Linear,
            mag_filter: Interpolation::Linear,
            mipmap: Some(Mipmap { filter: Interpolation::Nearest, ..Mipmap::default() }),
            wrap_s: Wrapping::Repeat,
            wrap_t: Wrapping::Repeat,
        })
        .collect();
    Texture2DArray::new(context, &layers.iter().collect::<Vec<_>>())
}
