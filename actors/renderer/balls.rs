//! The balls of a picture: all of one mesh in one draw.

use super::materials::{Facts, program};
use super::stage::darkening;
use super::textures;
use hapticbillard::ids::BallId;
use hapticbillard::picture::{BallDetail, Environment, PictureSettings, Shadows};
use hapticbillard::renderer::{
    BallInstance, DrawList, LAMPS, Shape, ball_look, shadow_reach_m, sphere,
};
use std::collections::BTreeMap;
use three_d::*;

/// As many balls are mirrored in each other and throw shadows on each other.
const MIRRORED: usize = 32;
/// Divisions of an icosahedron that there are meshes of.
const LEVELS: [u32; 3] = [2, 3, 4];
/// How far shadows float above the cloth [m]: above the marks on it.
const SHADOW_LIFT_M: f32 = 0.0011;
/// How far pockets reach into the bed [m].
const POCKET_M: f32 = 0.09;
/// How dark the shadow of a see-through ball is.
const GHOST_SHADOW: f32 = 0.6;

/// A sphere in the graphics card.
struct Sphere {
    corners: VertexBuffer<Vec3>,
    triangles: ElementBuffer<u32>,
}

impl Sphere {
    fn new(context: &Context, shape: &Shape) -> Self {
        let corners: Vec<Vec3> = shape.positions.iter().map(|at| Vec3::from(*at)).collect();
        Sphere {
            corners: VertexBuffer::new_with_data(context, &corners),
            triangles: ElementBuffer::new_with_data(context, &shape.indices),
        }
    }
}

/// What each ball of a group is told.
#[derive(Default)]
struct Group {
    places: Vec<Vec4>,
    turns: Vec<Vec4>,
    paints: Vec<Vec4>,
    traits: Vec<Vec4>,
}

impl Group {
    fn clear(&mut self) {
        self.places.clear();
        self.turns.clear();
        self.paints.clear();
        self.traits.clear();
    }

    fn push(&mut self, ball: &BallInstance, reflection: f32, scratches: f32) {
        let [x, y, z] = ball.position;
        self.places.push(vec4(x, y, z, ball.radius_m));
        self.turns.push(ball.orientation.into());
        let layer = ball.look.number.map_or(-1.0, |number| f32::from(number) - 1.0);
        self.paints.push(linear(ball.look.colour).extend(layer));
        let yes = |is_so: bool| f32::from(u8::from(is_so));
        let (striped, six) = (yes(ball.look.is_striped), yes(ball.look.has_six));
        self.traits.push(vec4(striped, six, reflection, scratches));
    }
}

/// A group in the graphics card.
struct Buffers {
    places: InstanceBuffer<Vec4>,
    turns: InstanceBuffer<Vec4>,
    paints: InstanceBuffer<Vec4>,
    traits: InstanceBuffer<Vec4>,
}

impl Buffers {
    fn new(context: &Context) -> Self {
        Buffers {
            places: InstanceBuffer::new(context),
            turns: InstanceBuffer::new(context),
            paints: InstanceBuffer::new(context),
            traits: InstanceBuffer::new(context),
        }
    }

    fn fill(&mut self, group: &Group) {
        self.places.fill(&group.places);
        self.turns.fill(&group.turns);
        self.paints.fill(&group.paints);
        self.traits.fill(&group.traits);
    }
}

/// Which variant of the ball's shader.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Variant {
    has_room: bool,
    shadows: u8,
    environment: u8,
    has_scratches: bool,
}

/// Meshes, textures and shaders of balls, and the balls of the picture.
pub struct Balls {
    context: Context,
    meshes: [Sphere; LEVELS.len()],
    square: Sphere,
    digits: BTreeMap<u16, Texture2DArray>,
    scratches: Option<Texture2D>,
    programs: BTreeMap<Variant, Program>,
    placed: Program,
    /// Shadows amid the cloth, and at cushions and pockets.
    contacts: [Program; 2],
    groups: [Group; LEVELS.len()],
    /// All of them, for whatever looks at all.
    all: Group,
    buffers: [Buffers; LEVELS.len()],
    places: InstanceBuffer<Vec4>,
    squares: InstanceBuffer<Vec3>,
}

impl Balls {
    /// Brings what all balls share into the graphics card.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let square = Shape {
            positions: [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[x, y]| [x, y, 0.0])
                .into(),
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Shape::default()
        };
        let contact =
            |at_edge| program(context, CONTACT_PLACE, &[("AT_EDGE", at_edge)], &[HIDDEN, CONTACT]);
        Ok(Balls {
            context: context.clone(),
            meshes: LEVELS.map(|level| Sphere::new(context, &sphere(level))),
            square: Sphere::new(context, &square),
            digits: BTreeMap::new(),
            scratches: None,
            programs: BTreeMap::new(),
            placed: program(context, BALL_PLACE, &[], &[NOTHING])?,
            contacts: [contact(0)?, contact(1)?],
            groups: Default::default(),
            all: Group::default(),
            buffers: LEVELS.map(|_| Buffers::new(context)),
            places: InstanceBuffer::new(context),
            squares: InstanceBuffer::new(context),
        })
    }

    /// Takes the balls of a picture for an eye [m], and gets ready what it takes to draw them.
    pub fn take(
        &mut self,
        list: &DrawList,
        eye: glam::Vec3,
        settings: &PictureSettings,
        has_room: bool,
        pixels_per_rad: f32,
    ) -> Result<(), CoreError> {
        self.groups.iter_mut().chain([&mut self.all]).for_each(Group::clear);
        for ball in &list.balls {
            let away = eye.distance(ball.position.into()).max(ball.radius_m);
            let detail = BallDetail::of(ball.radius_m / away * pixels_per_rad, settings);
            let group = LEVELS.iter().position(|level| *level == detail.level).unwrap_or(0);
            self.groups[group].push(ball, detail.reflection, detail.scratches);
            self.all.push(ball, detail.reflection, detail.scratches);
        }
        for (buffers, group) in self.buffers.iter_mut().zip(&self.groups) {
            buffers.fill(group);
        }
        let variant = variant(settings, has_room);
        if !self.programs.contains_key(&variant) {
            self.programs.insert(variant, ball_program(&self.context, variant)?);
        }
        if variant.has_scratches && self.scratches.is_none() {
            self.scratches = Some(textures::scratches(&self.context));
        }
        let side = settings.texture;
        self.digits.entry(side).or_insert_with(|| textures::digits(&self.context, side.into()));
        Ok(())
    }

    /// Draws the balls with their light.
    pub fn draw(
        &self,
        settings: &PictureSettings,
        camera: &Camera,
        facts: &Facts,
        tell: &dyn Fn(&Program),
    ) {
        let (Some(program), Some(digits)) = (
            self.programs.get(&variant(settings, facts.room.is_some())),
            self.digits.get(&settings.texture),
        ) else {
            return;
        };
        for (buffers, mesh) in self.buffers.iter().zip(&self.meshes) {
            let count = buffers.places.instance_count();
            if count == 0 {
                continue;
            }
            facts.tell(program, camera);
            tell(program);
            program.use_uniform_if_required("ivory", linear(ball_look(BallId::CUE).colour));
            program.use_texture_array("digits", digits);
            if let Some(scratches) = &self.scratches
                && program.requires_uniform("scratches")
            {
                program.use_texture("scratches", scratches);
            }
            self.tell_all(program);
            program.use_vertex_attribute("position", &mesh.corners);
            program.use_instance_attribute("place", &buffers.places);
            program.use_instance_attribute("turn", &buffers.turns);
            program.use_instance_attribute("paint", &buffers.paints);
            program.use_instance_attribute("traits", &buffers.traits);
            let states = RenderStates { cull: Cull::Back, ..RenderStates::default() };
            program.draw_elements_instanced(states, camera.viewport(), &mesh.triangles, count);
        }
    }

    /// Tells a shader of the other balls, if it wants to know.
    fn tell_all(&self, program: &Program) {
        let count = self.all.places.len().min(MIRRORED);
        program.use_uniform_if_required("ball_count", count as i32);
        let tell = |name: &str, values: &[Vec4]| {
            if program.requires_uniform(name) {
                let mut all = [vec4(0.0, 0.0, 0.0, 0.0); MIRRORED];
                all[..count].copy_from_slice(&values[..count]);
                program.use_uniform_array(name, &all);
            }
        };
        tell("ball_places", &self.all.places);
        tell("ball_turns", &self.all.turns);
        tell("ball_paints", &self.all.paints);
        tell("ball_traits", &self.all.traits);
    }

    /// The places of all balls.
    pub fn places(&self) -> &[Vec4] {
        &self.all.places
    }

    /// Draws where balls are, and not how they look.
    pub fn draw_depth(&self, view_projection: Mat4, viewport: Viewport) {
        // In the dark nobody counts triangles, but a picture's outline has to be the same.
        for (buffers, mesh) in self.buffers.iter().zip(&self.meshes) {
            let count = buffers.places.instance_count();
            if count == 0 {
                continue;
            }
            self.placed.use_uniform("view_projection", view_projection);
            self.placed.use_vertex_attribute("position", &mesh.corners);
            self.placed.use_instance_attribute("place", &buffers.places);
            let states = RenderStates {
                write_mask: WriteMask::DEPTH,
                cull: Cull::Back,
                ..RenderStates::default()
            };
            self.placed.draw_elements_instanced(states, viewport, &mesh.triangles, count);
        }
    }

    /// Darkens the cloth under balls and see-through balls.
    pub fn draw_contacts(
        &mut self,
        list: &DrawList,
        camera: &Camera,
        facts: &Facts,
        pockets: &[Vec3],
    ) {
        let solid = list.balls.iter().map(|ball| (ball.position, ball.radius_m, 1.0));
        let ghosts = list.ghosts.iter().map(|ghost| (ghost.position, ghost.radius_m, GHOST_SHADOW));
        let mut groups: [(Vec<Vec4>, Vec<Vec3>); 2] = Default::default();
        for ([x, y, z], radius_m, depth) in solid.chain(ghosts) {
            if let Some(reach_m) = shadow_reach_m(radius_m, z) {
                // Pockets are never farther from the cushions than a little more than their radius.
                let reaches_edge = facts.bed.x > 0.0
                    && (x.abs() + reach_m > facts.bed.x - POCKET_M
                        || y.abs() + reach_m > facts.bed.y - POCKET_M);
                let (places, squares) = &mut groups[usize::from(reaches_edge)];
                places.push(vec4(x, y, z, radius_m));
                squares.push(vec3(reach_m, SHADOW_LIFT_M, depth));
            }
        }
        for (program, (places, squares)) in self.contacts.iter().zip(&groups) {
            if places.is_empty() {
                continue;
            }
            self.places.fill(places);
            self.squares.fill(squares);
            facts.tell(program, camera);
            if program.requires_uniform("pockets") {
                program.use_uniform_array("pockets", pockets);
            }
            program.use_vertex_attribute("position", &self.square.corners);
            program.use_instance_attribute("place", &self.places);
            program.use_instance_attribute("square", &self.squares);
            let (triangles, count) = (&self.square.triangles, places.len() as u32);
            program.draw_elements_instanced(darkening(), camera.viewport(), triangles, count);
        }
    }
}

const BALL_PLACE: &str = include_str!("shaders/ball_place.vert");
const NOTHING: &str = include_str!("shaders/nothing.frag");
const CONTACT_PLACE: &str = include_str!("shaders/contact.vert");
const HIDDEN: &str = include_str!("shaders/hidden.glsl");
const CONTACT: &str = include_str!("shaders/contact.frag");

fn variant(settings: &PictureSettings, has_room: bool) -> Variant {
    Variant {
        has_room,
        shadows: shadow_number(settings.shadows),
        environment: match settings.environment {
            Environment::Off => 0,
            Environment::Room => 1,
            Environment::All => 2,
        },
        has_scratches: settings.normal_map,
    }
}

/// What a shader's SHADOWS is.
pub fn shadow_number(shadows: Shadows) -> u8 {
    match shadows {
        Shadows::Off => 0,
        Shadows::Soft => 1,
        Shadows::Maps => 2,
        Shadows::Volumes => 3,
    }
}

fn ball_program(context: &Context, variant: Variant) -> Result<Program, CoreError> {
    let Variant { has_room, shadows, environment, has_scratches } = variant;
    let set = [
        ("ROOM", u32::from(has_room)),
        ("SHADOWS", shadows.into()),
        ("ENVIRONMENT", environment.into()),
        ("SCRATCHES", u32::from(has_scratches)),
    ];
    let seen = include_str!("shaders/seen.glsl");
    let texts =
        [seen, HIDDEN, include_str!("shaders/balls.glsl"), include_str!("shaders/ball.frag")];
    program(context, include_str!("shaders/ball.vert"), &set, &texts)
}

/// A colour of the screen as light.
pub fn linear(srgb: [f32; 3]) -> Vec3 {
    Vec3::from(srgb.map(|channel| channel.powf(2.2)))
}

/// The lamps as vectors.
pub fn lamps() -> [Vec3; 3] {
    LAMPS.map(Vec3::from)
}
