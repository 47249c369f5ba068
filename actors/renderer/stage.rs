//! The stage: what a graphics card holds of a game, and one picture of it.
//!
//! Everything here lives and dies on the thread that owns the graphics context.

use super::materials::{Shader, Told};
use super::room::RoomStage;
use super::room_light::RoomLight;
use super::textures;
use hapticbillard::cue::CuePose;
use hapticbillard::ids::BallId;
use hapticbillard::input::CameraPose;
use hapticbillard::mesh::Surface;
use hapticbillard::renderer::{
    BallInstance, DrawList, GhostBall, Line, Shape, Solid, SolidShape, StylusPose,
};
use hapticbillard::renderer::{ball_look, cone, cue_shape, cylinder, sphere, stylus_shape};
use hapticbillard::table::{ClothMarks, DisplayPart, Material as Made, Table};
use three_d::*;

/// How often an icosahedron's triangles are divided: 1280 triangles a ball.
const BALL_LEVEL: u32 = 3;
/// How far shadows float above the cloth [m]: above the marks on it.
const SHADOW_LIFT_M: f32 = 0.0011;
/// Half the side of a shadow's square, in radii.
const SHADOW_REACH: f32 = 5.0;
/// Half the side of endless ground [m].
const GROUND_M: f32 = 8.0;

/// What the picture is cleared to: the dark of the room.
pub const BACKGROUND: [f32; 3] = [0.130, 0.127, 0.136];

/// Meshes and textures.
pub struct Stage {
    parts: Vec<(Shader, Mesh)>,
    ball: Mesh,
    cue: Mesh,
    square: Mesh,
    stylus: Mesh,
    cylinder: Mesh,
    cone: Mesh,
    digits: Texture2DArray,
    nap: Texture2D,
    wood: Texture2D,
    bed: Vec2,
    outer: Vec2,
    line_and_d: Vec2,
    spots: [Vec2; 6],
    pockets: [Vec3; 6],
    room: Option<RoomStage>,
    light: RoomLight,
}

impl Stage {
    /// Brings a table into the graphics card.
    pub fn new(context: &Context, table: &Table) -> Self {
        let (room, light) = match RoomStage::around(context, table) {
            Some((room, light)) => (Some(room), light),
            None => (None, RoomLight::none(context)),
        };
        let mut parts: Vec<(Shader, Mesh)> = table
            .display()
            .iter()
            .filter(|part| room.is_none() || !RoomStage::draws(part.name))
            // Marks are thinner than a pixel from afar: the cloth's shader paints them.
            .filter(|part| part.material != Made::Line)
            .map(|part| {
                (Shader::Surface(kind(part.material)), Mesh::new(context, &part_mesh(part)))
            })
            .collect();
        if table.bed.is_none() {
            let level = table.planes.iter().filter(|plane| plane.normal.z > 0.9);
            parts.extend(level.map(|plane| {
                let made = if plane.surface == Surface::Cloth { Made::Cloth } else { Made::Floor };
                let mesh = Mesh::new(context, &ground(plane.point.z as f32));
                (Shader::Surface(kind(made)), mesh)
            }));
        }
        let mut pockets = [vec3(0.0, 0.0, -1.0); 6];
        for (place, pocket) in pockets.iter_mut().zip(&table.pockets) {
            let centre = pocket.centre.as_vec2();
            *place = vec3(centre.x, centre.y, pocket.radius_m as f32);
        }
        let bed = table.bed.map_or(vec2(0.0, 0.0), |bed| {
            vec2(0.5 * bed.length_m as f32, 0.5 * bed.width_m as f32)
        });
        let (line_and_d, spots) = table.parameters.as_ref().map_or_else(
            || (vec2(0.0, 0.0), [vec2(0.0, 0.0); 6]),
            |parameters| marks(&parameters.cloth_marks()),
        );
        Stage {
            parts,
            ball: Mesh::new(context, &shape_mesh(&sphere(BALL_LEVEL))),
            cue: Mesh::new(context, &shape_mesh(&cue_shape())),
            square: Mesh::new(context, &square()),
            stylus: Mesh::new(context, &shape_mesh(&stylus_shape())),
            cylinder: Mesh::new(context, &shape_mesh(&cylinder())),
            cone: Mesh::new(context, &shape_mesh(&cone())),
            digits: textures::digits(context),
            nap: textures::nap(context),
            wood: textures::wood(context),
            bed,
            line_and_d,
            spots,
            outer: bed + vec2(0.2, 0.2),
            pockets,
            room,
            light,
        }
    }

    /// Draws a picture into whatever is the target now.
    pub fn draw(&mut self, list: &DrawList, viewport: Viewport) {
        let camera = camera(&list.camera, viewport);
        // Balls hide much of the cloth, so they come first.
        for ball in &list.balls {
            self.ball(ball, &camera);
        }
        if let Some(cue) = &list.cue {
            self.cue(cue, &camera);
        }
        if let Some(stylus) = &list.stylus {
            self.stylus(stylus, &camera);
        }
        for (shader, mesh) in &self.parts {
            let is_cloth = matches!(shader, Shader::Surface(0 | 1));
            let grain = if is_cloth { &self.nap } else { &self.wood };
            let (outer, line_and_d, spots) = (self.outer, self.line_and_d, &self.spots);
            let tell = |program: &Program| {
                if program.requires_uniform("grain") {
                    program.use_texture("grain", grain);
                }
                program.use_uniform_if_required("outer", outer);
                program.use_uniform_if_required("line_and_d", line_and_d);
                if program.requires_uniform("spots") {
                    program.use_uniform_array("spots", spots);
                }
            };
            self.render(mesh, *shader, &tell, &camera);
        }
        if let Some(room) = &self.room {
            room.draw(&self.light, self.bed, &camera);
        }
        for ball in &list.balls {
            self.shadow(ball.position, ball.radius_m, &camera);
        }
        for line in &list.lines {
            self.line(line, &camera);
        }
        for ghost in &list.ghosts {
            self.shadow(ghost.position, ghost.radius_m, &camera);
            self.ghost(ghost, &camera);
        }
        for solid in &list.solids {
            self.solid(solid, &camera);
        }
    }

    fn render(&self, mesh: &Mesh, shader: Shader, tell: &dyn Fn(&Program), camera: &Camera) {
        let material = Told { shader, tell, bed: self.bed, room: &self.light };
        mesh.render_with_material(&material, camera, &[]);
    }

    fn ball(&mut self, ball: &BallInstance, camera: &Camera) {
        let centre = Vec3::from(ball.position);
        let [x, y, z, w] = ball.orientation;
        let turned = Mat3::from(Quat::new(w, x, y, z));
        self.ball
            .set_transformation(Mat4::from_translation(centre) * Mat4::from_scale(ball.radius_m));
        let digits = &self.digits;
        let tell = |program: &Program| {
            program.use_uniform_if_required("centre", centre);
            program.use_uniform_if_required("turned", turned);
            program.use_uniform_if_required("paint", linear(ball.look.colour));
            program.use_uniform_if_required("ivory", linear(ball_look(BallId::CUE).colour));
            program.use_uniform_if_required("striped", f32::from(u8::from(ball.look.is_striped)));
            let layer = ball.look.number.map_or(-1.0, |number| f32::from(number) - 1.0);
            program.use_uniform_if_required("number", layer);
            program.use_uniform_if_required("radius", ball.radius_m);
            program.use_texture_array("digits", digits);
        };
        self.render(&self.ball, Shader::Ball, &tell, camera);
    }

    fn cue(&mut self, cue: &CuePose, camera: &Camera) {
        let (tip, along) = (cue.tip.as_vec3().to_array(), cue.direction.as_vec3().to_array());
        self.cue.set_transformation(laid(tip.into(), along.into(), 1.0, 1.0));
        self.render(&self.cue, Shader::Painted, &|_| {}, camera);
    }

    fn stylus(&mut self, stylus: &StylusPose, camera: &Camera) {
        let (tip, along) = (Vec3::from(stylus.tip), Vec3::from(stylus.direction));
        self.stylus.set_transformation(laid(tip, along, stylus.scale, stylus.scale));
        self.render(&self.stylus, Shader::Painted, &|_| {}, camera);
    }

    fn solid(&mut self, solid: &Solid, camera: &Camera) {
        let (from, way) = (Vec3::from(solid.from), Vec3::from(solid.to) - Vec3::from(solid.from));
        let mesh = match solid.shape {
            SolidShape::Ball => &mut self.ball,
            SolidShape::Cylinder => &mut self.cylinder,
            SolidShape::Cone => &mut self.cone,
        };
        let (length, width) = (way.magnitude(), solid.radius_m);
        let placed = match solid.shape {
            SolidShape::Ball => Mat4::from_translation(from) * Mat4::from_scale(width),
            _ if length < 1e-6 => return,
            _ => laid(from, way / length, length, width),
        };
        mesh.set_transformation(placed);
        let mesh: &Mesh = match solid.shape {
            SolidShape::Ball => &self.ball,
            SolidShape::Cylinder => &self.cylinder,
            SolidShape::Cone => &self.cone,
        };
        let colour = solid.colour;
        let tell = |program: &Program| {
            program.use_uniform_if_required("tint", Vec4::from(colour));
            program.use_uniform_if_required("rim", 0.0);
            program.use_uniform_if_required("shade", 1.0);
        };
        let shader = if solid.is_over { Shader::Over } else { Shader::Plain };
        self.render(mesh, shader, &tell, camera);
    }

    fn shadow(&mut self, position: [f32; 3], radius_m: f32, camera: &Camera) {
        let centre = Vec3::from(position);
        // A ball in the air, or on its way down a pocket, throws none that is worth drawing.
        if centre.z < 0.5 * radius_m || 6.0 * radius_m < centre.z {
            return;
        }
        self.square.set_transformation(
            Mat4::from_translation(vec3(centre.x, centre.y, SHADOW_LIFT_M))
                * Mat4::from_scale(SHADOW_REACH * radius_m),
        );
        let pockets = self.pockets;
        let tell = |program: &Program| {
            program.use_uniform_if_required("centre", centre);
            program.use_uniform_if_required("radius", radius_m);
            program.use_uniform_array("pockets", &pockets);
        };
        self.render(&self.square, Shader::Shadow, &tell, camera);
    }

    fn line(&mut self, line: &Line, camera: &Camera) {
        let (from, to) = (Vec3::from(line.from), Vec3::from(line.to));
        let along = (to - from) * 0.5;
        if along.magnitude2() < 1e-8 {
            return;
        }
        let aside = vec3(0.0, 0.0, 1.0).cross(along).normalize() * line.half_width_m;
        self.square.set_transformation(Mat4::from_cols(
            along.extend(0.0),
            aside.extend(0.0),
            vec4(0.0, 0.0, 1.0, 0.0),
            ((from + to) * 0.5).extend(1.0),
        ));
        self.plain(&self.square, line.colour, 0.0, camera);
    }

    fn ghost(&mut self, ghost: &GhostBall, camera: &Camera) {
        self.ball.set_transformation(
            Mat4::from_translation(ghost.position.into()) * Mat4::from_scale(ghost.radius_m),
        );
        self.plain(&self.ball, ghost.colour, 1.0, camera);
    }

    fn plain(&self, mesh: &Mesh, colour: [f32; 4], rim: f32, camera: &Camera) {
        let tell = |program: &Program| {
            program.use_uniform_if_required("tint", Vec4::from(colour));
            program.use_uniform_if_required("rim", rim);
            program.use_uniform_if_required("shade", 0.0);
        };
        self.render(mesh, Shader::Plain, &tell, camera);
    }
}

/// What the cloth's shader paints: the line across with the D behind it, and six spots, of which
/// some may be the same.
fn marks(marks: &ClothMarks) -> (Vec2, [Vec2; 6]) {
    let first = marks.spots.first().copied().unwrap_or_default().as_vec2();
    let mut spots = [vec2(first.x, first.y); 6];
    for (place, spot) in spots.iter_mut().zip(&marks.spots) {
        *place = vec2(spot.x as f32, spot.y as f32);
    }
    let d_radius_m = marks.d_radius_m.unwrap_or(0.0);
    // No line is one that lies beyond every table.
    let line_x_m = marks.line_x_m.unwrap_or(-1e3);
    (vec2(line_x_m as f32, d_radius_m as f32), spots)
}

/// From a body along +x to one at `at` along a unit vector, longer and wider by these factors.
fn laid(at: Vec3, along: Vec3, length: f32, width: f32) -> Mat4 {
    let side = vec3(0.0, 0.0, 1.0).cross(along);
    let side = if side.magnitude2() < 1e-6 { vec3(0.0, 1.0, 0.0) } else { side.normalize() };
    let up = along.cross(side);
    Mat4::from_cols(
        (along * length).extend(0.0),
        (side * width).extend(0.0),
        (up * width).extend(0.0),
        at.extend(1.0),
    )
}

fn kind(made: Made) -> u16 {
    match made {
        Made::Cloth => 0,
        Made::CushionCloth => 1,
        Made::Wood => 2,
        Made::DarkWood => 3,
        Made::Casting => 4,
        Made::Leather => 5,
        Made::Diamond => 6,
        Made::Line => 7,
        Made::Floor => 8,
    }
}

fn linear(srgb: [f32; 3]) -> Vec3 {
    Vec3::from(srgb.map(|channel| channel.powf(2.2)))
}

fn camera(pose: &CameraPose, viewport: Viewport) -> Camera {
    let (eye, target) = (pose.eye.as_vec3(), pose.target.as_vec3());
    Camera::new_perspective(
        viewport,
        vec3(eye.x, eye.y, eye.z),
        vec3(target.x, target.y, target.z),
        vec3(0.0, 0.0, 1.0),
        radians(pose.field_of_view_rad as f32),
        0.05,
        25.0,
    )
}

fn vectors(triples: &[[f32; 3]]) -> Vec<Vec3> {
    triples.iter().map(|triple| Vec3::from(*triple)).collect()
}

fn part_mesh(part: &DisplayPart) -> CpuMesh {
    CpuMesh {
        positions: Positions::F32(vectors(&part.positions)),
        normals: Some(vectors(&part.normals)),
        uvs: Some(part.uvs.iter().map(|uv| vec2(uv[0], uv[1])).collect()),
        indices: Indices::U32(part.indices.clone()),
        ..CpuMesh::default()
    }
}

fn shape_mesh(shape: &Shape) -> CpuMesh {
    let byte = |channel: f32| (channel * 255.0).round() as u8;
    let colours = shape.colours.iter().map(|&[r, g, b]| Srgba::new(byte(r), byte(g), byte(b), 255));
    CpuMesh {
        positions: Positions::F32(vectors(&shape.positions)),
        normals: Some(vectors(&shape.normals)),
        colors: (!shape.colours.is_empty()).then(|| colours.collect()),
        indices: Indices::U32(shape.indices.clone()),
        ..CpuMesh::default()
    }
}

fn square() -> CpuMesh {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    CpuMesh {
        positions: Positions::F32(corners.iter().map(|&(x, y)| vec3(x, y, 0.0)).collect()),
        normals: Some(vec![vec3(0.0, 0.0, 1.0); 4]),
        indices: Indices::U32(vec![0, 1, 2, 0, 2, 3]),
        ..CpuMesh::default()
    }
}

fn ground(height: f32) -> CpuMesh {
    let mut mesh = square();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let places = corners.map(|(x, y)| vec3(x * GROUND_M, y * GROUND_M, height));
    mesh.uvs = Some(places.iter().map(|p| vec2(p.x, p.y)).collect());
    mesh.positions = Positions::F32(places.to_vec());
    mesh
}
