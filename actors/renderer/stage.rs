//! The stage: what a graphics card holds of a game, and one picture of it.
//!
//! Everything here lives and dies on the thread that owns the graphics context.

use super::balls::{Balls, shadow_number};
use super::materials::{Facts, Finish, Shader, Told, program};
use super::meshes::{ground, laid, marks, part_mesh, shape_mesh, square};
use super::room::RoomPlace;
use super::shadows::{DownEye, Maps, Volumes};
use super::still::Stills;
use super::textures;
use hapticbillard::cue::{BUTT_RADIUS_M, CUE_LENGTH_M, CuePose, TIP_RADIUS_M};
use hapticbillard::input::CameraPose;
use hapticbillard::mesh::Surface;
use hapticbillard::picture::{PictureSettings, Shadows};
use hapticbillard::renderer::{
    DrawList, GhostBall, Line, Solid, SolidShape, StylusPose, cone, cue_shadow, cue_shape,
    cylinder, sphere, stylus_shape,
};
use hapticbillard::table::{Material as Made, Table};
use std::sync::Arc;
use three_d::*;

/// How often the triangles of see-through balls are divided.
const GHOST_LEVEL: u32 = 3;
/// How far the shadow of a cue floats above the cloth [m].
const CUE_SHADOW_LIFT_M: f32 = 0.0011;

/// Size of the picture of a table from above [pixels], and how far it reaches beyond the table [m].
const PLAN: (u32, u32) = (2048, 1024);
const PLAN_MARGIN_M: f32 = 0.02;
/// The numbers of some surfaces.
const APRON: u16 = 3;
const POCKET: u16 = 5;
const FLOOR: u16 = 8;

/// Height under which the balls on a table darken nothing [m].
const UNDER_CLOTH_M: f32 = -0.12;

/// What the picture is cleared to: the dark of the room.
pub const BACKGROUND: [f32; 3] = [0.130, 0.127, 0.136];

/// A part of a table, or of the floor about it.
struct Part {
    /// What the shader's KIND is.
    kind: u16,
    mesh: Mesh,
    /// Where a room is drawn, it is a part of that.
    is_of_room: bool,
}

/// Meshes and textures.
pub struct Stage {
    context: Context,
    parts: Vec<Part>,
    balls: Balls,
    ghost: Mesh,
    cue: Mesh,
    cue_shadow: Program,
    square: Mesh,
    cue_corners: VertexBuffer<Vec3>,
    stylus: Mesh,
    cylinder: Mesh,
    cone: Mesh,
    nap: Texture2D,
    wood: Texture2D,
    bed: Vec2,
    outer: Vec2,
    line_and_d: Vec2,
    spots: ([Vec2; 6], i32),
    pockets: [Vec3; 6],
    /// Made when they are first wanted: the table from above, in the light of a room or none, and
    /// what shadows need.
    plan: Option<(bool, Texture2D)>,
    maps: Option<Maps>,
    volumes: Option<Volumes>,
    room: RoomPlace,
    stills: Stills,
}

impl Stage {
    /// Brings a table into the graphics card.
    ///
    /// # Errors
    /// Its compiler does not take a shader.
    pub fn new(context: &Context, table: &Arc<Table>) -> Result<Self, CoreError> {
        let mut parts: Vec<Part> = table
            .display()
            .iter()
            // Marks are thinner than a pixel from afar: the cloth's shader paints them.
            .filter(|part| part.material != Made::Line)
            .map(|part| Part {
                kind: kind(part.material),
                mesh: Mesh::new(context, &part_mesh(part)),
                is_of_room: RoomPlace::draws(part.name),
            })
            .collect();
        if table.bed.is_none() {
            let level = table.planes.iter().filter(|plane| plane.normal.z > 0.9);
            parts.extend(level.map(|plane| {
                let made = if plane.surface == Surface::Cloth { Made::Cloth } else { Made::Floor };
                let mesh = Mesh::new(context, &ground(plane.point.z as f32));
                Part { kind: kind(made), mesh, is_of_room: false }
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
            || (vec2(0.0, 0.0), ([vec2(0.0, 0.0); 6], 0)),
            |parameters| marks(&parameters.cloth_marks()),
        );
        let (place, shade) =
            (include_str!("shaders/cue_shadow.vert"), include_str!("shaders/cue_shadow.frag"));
        Ok(Stage {
            parts,
            balls: Balls::new(context)?,
            ghost: Mesh::new(context, &shape_mesh(&sphere(GHOST_LEVEL))),
            cue: Mesh::new(context, &shape_mesh(&cue_shape())),
            cue_shadow: program(context, place, &[], &[shade])?,
            square: Mesh::new(context, &square()),
            cue_corners: VertexBuffer::new(context),
            stylus: Mesh::new(context, &shape_mesh(&stylus_shape())),
            cylinder: Mesh::new(context, &shape_mesh(&cylinder())),
            cone: Mesh::new(context, &shape_mesh(&cone())),
            nap: textures::nap(context),
            wood: textures::wood(context),
            bed,
            line_and_d,
            spots,
            outer: bed + vec2(0.2, 0.2),
            pockets,
            plan: None,
            maps: None,
            volumes: None,
            room: RoomPlace::round(table.clone()),
            stills: Stills::new(context)?,
            context: context.clone(),
        })
    }

    /// The same table in another context.
    ///
    /// # Errors
    /// Its compiler does not take a shader.
    pub fn anew(&self, context: &Context) -> Result<Self, CoreError> {
        Stage::new(context, self.room.table())
    }

    /// Gets ready what a picture of this size needs, seen by an eye, in pictures of its own: no
    /// target may be written to meanwhile.
    ///
    /// # Errors
    /// The graphics card's compiler does not take a shader, or it gives no room.
    pub fn prepare(
        &mut self,
        list: &DrawList,
        eye: &CameraPose,
        settings: &PictureSettings,
        viewport: Viewport,
    ) -> Result<Camera, CoreError> {
        let camera = camera(eye, viewport);
        let pixels_per_rad =
            viewport.height as f32 / (2.0 * (0.5 * eye.field_of_view_rad as f32).tan());
        let has_room = self.room.show(settings.room, &self.context);
        self.balls.take(list, eye.eye.as_vec3(), settings, has_room, pixels_per_rad)?;
        if let Some(cue) = &list.cue {
            let (tip, along) = (cue.tip.as_vec3().to_array(), cue.direction.as_vec3().to_array());
            self.cue.set_transformation(laid(tip.into(), along.into(), 1.0, 1.0));
        }
        let is_old = self.plan.as_ref().is_none_or(|(of, _)| *of != has_room);
        if self.is_plain(settings) && is_old {
            self.plan = Some((has_room, self.seen_from_above()?));
        }
        let cue = list.cue.as_ref().map(|_| &self.cue);
        // Nobody sees how bright the dark is.
        let facts = Facts { bed: self.bed, room: None };
        match settings.shadows {
            Shadows::Maps => {
                let frame = if self.bed.x > 0.0 { self.outer } else { vec2(2.0, 1.0) };
                let maps = self.maps.get_or_insert_with(|| Maps::new(&self.context, frame));
                maps.draw(&self.balls, cue, facts)?;
            }
            Shadows::Volumes => {
                let volumes = match &mut self.volumes {
                    Some(volumes) => volumes,
                    none => none.insert(Volumes::new(&self.context)?),
                };
                let told = Told { shader: Shader::Depth, tell: &|_| {}, facts };
                let meshes = seen(&self.parts, has_room).map(|part| &part.mesh).chain(cue);
                let lowest = if self.bed.x > 0.0 { UNDER_CLOTH_M } else { -4.0 };
                volumes.draw(&self.balls, list.cue.as_ref(), lowest, &camera, || {
                    meshes.for_each(|mesh| mesh.render_with_material(&told, &camera, &[]));
                })?;
            }
            Shadows::Off | Shadows::Soft => {}
        }
        Ok(camera)
    }

    /// Draws what stands still once for all pictures that an eye sees where it rests now: for
    /// targets of one sample per pixel. After [`Self::prepare`], and as that.
    ///
    /// # Errors
    /// The graphics card gives no room.
    pub fn rest(&mut self, settings: &PictureSettings, camera: &Camera) -> Result<(), CoreError> {
        // Shadows of these kinds move on what stands still.
        if matches!(settings.shadows, Shadows::Maps | Shadows::Volumes) {
            return Ok(());
        }
        if let Some(still) = self.stills.see(settings, camera) {
            still.write(|| self.standing(settings, camera, &|_| {}))?;
            self.stills.keep(still);
        }
        Ok(())
    }

    /// Whether [`Self::draw`] has that for such a picture, and so draws every pixel of it.
    pub fn rests(&self, settings: &PictureSettings, camera: &Camera) -> bool {
        self.stills.has(settings, camera)
    }

    /// Draws a picture that is prepared into whatever is the target now.
    pub fn draw(&mut self, list: &DrawList, settings: &PictureSettings, camera: &Camera) {
        let is_kept = self.stills.put(list, self.bed, settings, camera);
        if let Some(stylus) = &list.stylus {
            self.stylus(stylus, camera);
        }
        let (maps, volumes, viewport) = (&self.maps, &self.volumes, camera.viewport());
        let shadows = settings.shadows;
        let tell_shadows = |program: &Program| match (shadows, maps, volumes) {
            (Shadows::Maps, Some(maps), _) => maps.tell(program),
            (Shadows::Volumes, _, Some(volumes)) => volumes.tell(program, viewport),
            _ => {}
        };
        // Balls hide much of the cloth, so they come first.
        self.balls.draw(settings, camera, &self.facts(), &tell_shadows);
        if list.cue.is_some() {
            self.render(&self.cue, Shader::Painted, &|_| {}, camera);
        }
        if !is_kept {
            self.standing(settings, camera, &tell_shadows);
        }
        if shadows == Shadows::Soft {
            let facts = Facts { bed: self.bed, room: self.room.light() };
            self.balls.draw_contacts(list, camera, &facts, &self.pockets);
            if let Some(cue) = &list.cue {
                self.shade_cue(cue, camera);
            }
        }
        for line in &list.lines {
            self.line(line, camera);
        }
        for ghost in &list.ghosts {
            self.ghost(ghost, camera);
        }
        for solid in &list.solids {
            self.solid(solid, camera);
        }
    }

    /// Draws what moves only if the eye does.
    fn standing(
        &self,
        settings: &PictureSettings,
        camera: &Camera,
        tell_shadows: &dyn Fn(&Program),
    ) {
        let shadows = settings.shadows;
        let finish = Finish {
            // Soft shadows lie on the cloth and are not in it.
            shadows: if shadows == Shadows::Soft { 0 } else { shadow_number(shadows) },
            has_detail: settings.cloth_detail,
        };
        if let Some(plan) =
            self.plan.as_ref().filter(|_| self.is_plain(settings)).map(|(_, plan)| plan)
        {
            let (frame, outer) = (self.plan_frame(), self.outer);
            let tell = |program: &Program| {
                program.use_uniform_if_required("outer", outer);
                program.use_uniform_if_required("plan_frame", frame);
                if program.requires_uniform("plan") {
                    program.use_texture("plan", plan);
                }
            };
            for Part { kind, mesh, .. } in self.seen_parts() {
                match *kind {
                    FLOOR => self.render(mesh, Shader::PlanFloor, &tell, camera),
                    // They are under what is seen from above.
                    APRON | POCKET => {
                        let tell = self.told(*kind, tell_shadows);
                        self.render(mesh, Shader::Surface(*kind, finish), &tell, camera);
                    }
                    _ => self.render(mesh, Shader::Plan, &tell, camera),
                }
            }
        } else {
            self.parts(finish, camera, tell_shadows);
        }
        self.room.draw(self.bed, camera);
    }

    /// What all shaders know.
    fn facts(&self) -> Facts<'_> {
        Facts { bed: self.bed, room: self.room.light() }
    }

    fn seen_parts(&self) -> impl Iterator<Item = &Part> {
        seen(&self.parts, self.room.light().is_some())
    }

    /// Draws the table, and what there is without a room, every pixel in its light.
    fn parts(&self, finish: Finish, camera: &dyn Viewer, tell_shadows: &dyn Fn(&Program)) {
        for Part { kind, mesh, .. } in self.seen_parts() {
            let tell = self.told(*kind, tell_shadows);
            self.render(mesh, Shader::Surface(*kind, finish), &tell, camera);
        }
    }

    /// Tells the shader of a surface what there is on it.
    fn told<'a>(&'a self, kind: u16, tell_shadows: &'a dyn Fn(&Program)) -> impl Fn(&Program) + 'a {
        let grain = if kind < 2 { &self.nap } else { &self.wood };
        move |program: &Program| {
            if program.requires_uniform("grain") {
                program.use_texture("grain", grain);
            }
            program.use_uniform_if_required("outer", self.outer);
            program.use_uniform_if_required("line_and_d", self.line_and_d);
            if program.requires_uniform("spots") {
                program.use_uniform_array("spots", &self.spots.0);
            }
            program.use_uniform_if_required("spot_count", self.spots.1);
            tell_shadows(program);
        }
    }

    /// Whether the table is drawn from one picture of itself.
    fn is_plain(&self, settings: &PictureSettings) -> bool {
        self.bed.x > 0.0 && settings.is_table_plain()
    }

    /// Half the length and width of what is in that picture [m].
    fn plan_frame(&self) -> Vec2 {
        self.outer + vec2(PLAN_MARGIN_M, PLAN_MARGIN_M)
    }

    /// The table from above.
    fn seen_from_above(&self) -> Result<Texture2D, CoreError> {
        let (edge, soft) = (Wrapping::ClampToEdge, Interpolation::Linear);
        let (width, height) = PLAN;
        let colour = Texture2D::new_empty::<[u8; 4]>(
            &self.context,
            width,
            height,
            soft,
            soft,
            None,
            edge,
            edge,
        );
        let depth = DepthTexture2D::new::<f32>(&self.context, width, height, edge, edge);
        let eye = DownEye::from_above(self.plan_frame(), PLAN);
        let target = RenderTarget::new(colour.as_color_target(None), depth.as_depth_target());
        let [r, g, b] = BACKGROUND;
        target.clear(ClearState::color_and_depth(r, g, b, 1.0, 1.0)).write::<CoreError>(|| {
            self.parts(Finish { shadows: 0, has_detail: false }, &eye, &|_| {});
            Ok(())
        })?;
        drop(target);
        Ok(colour)
    }

    fn render(&self, mesh: &Mesh, shader: Shader, tell: &dyn Fn(&Program), camera: &dyn Viewer) {
        let material = Told { shader, tell, facts: self.facts() };
        mesh.render_with_material(&material, camera, &[]);
    }

    /// Darkens the cloth under a cue.
    fn shade_cue(&mut self, cue: &CuePose, camera: &Camera) {
        let area = cue_shadow(cue, glam::Vec2::new(self.bed.x, self.bed.y));
        let on_cloth = |at: glam::Vec2| vec3(at.x, at.y, CUE_SHADOW_LIFT_M);
        let corners: Vec<Vec3> = area
            .windows(2)
            .skip(1)
            .flat_map(|pair| [area[0], pair[0], pair[1]].map(on_cloth))
            .collect();
        if corners.is_empty() {
            return;
        }
        let (tip, along) = (cue.tip.as_vec3(), cue.direction.as_vec3());
        let butt = tip - along * CUE_LENGTH_M as f32;
        let program = &self.cue_shadow;
        self.cue_corners.fill(&corners);
        self.facts().tell(program, camera);
        program.use_uniform("tip", vec4(tip.x, tip.y, tip.z, TIP_RADIUS_M as f32));
        program.use_uniform("butt", vec4(butt.x, butt.y, butt.z, BUTT_RADIUS_M as f32));
        program.use_uniform_array("pockets", &self.pockets);
        program.use_vertex_attribute("position", &self.cue_corners);
        program.draw_arrays(darkening(), camera.viewport(), self.cue_corners.vertex_count());
    }

    fn stylus(&mut self, stylus: &StylusPose, camera: &Camera) {
        let (tip, along) = (Vec3::from(stylus.tip), Vec3::from(stylus.direction));
        self.stylus.set_transformation(laid(tip, along, stylus.scale, stylus.scale));
        self.render(&self.stylus, Shader::Painted, &|_| {}, camera);
    }

    fn solid(&mut self, solid: &Solid, camera: &Camera) {
        let (from, way) = (Vec3::from(solid.from), Vec3::from(solid.to) - Vec3::from(solid.from));
        let mesh = match solid.shape {
            SolidShape::Ball => &mut self.ghost,
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
            SolidShape::Ball => &self.ghost,
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
        self.ghost.set_transformation(
            Mat4::from_translation(ghost.position.into()) * Mat4::from_scale(ghost.radius_m),
        );
        self.plain(&self.ghost, ghost.colour, 1.0, camera);
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

/// The parts that are drawn: a room brings some of its own.
fn seen(parts: &[Part], has_room: bool) -> impl Iterator<Item = &Part> {
    parts.iter().filter(move |part| !(has_room && part.is_of_room))
}

/// What is there already is multiplied by what is drawn.
pub fn darkening() -> RenderStates {
    RenderStates {
        write_mask: WriteMask::COLOR,
        blend: Blend::Enabled {
            source_rgb_multiplier: BlendMultiplierType::Zero,
            source_alpha_multiplier: BlendMultiplierType::Zero,
            destination_rgb_multiplier: BlendMultiplierType::SrcColor,
            destination_alpha_multiplier: BlendMultiplierType::One,
            rgb_equation: BlendEquationType::Add,
            alpha_equation: BlendEquationType::Add,
        },
        cull: Cull::Back,
        ..RenderStates::default()
    }
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
