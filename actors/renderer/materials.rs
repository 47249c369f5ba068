//! Shaders as materials: each one a text, its render states and what it is told.

use super::room_light::RoomLight;
use hapticbillard::renderer::{LAMP_APART_M, LAMP_HEIGHT_M};
use three_d::*;

const LIGHT: &str = include_str!("shaders/light.glsl");
const SEEN: &str = include_str!("shaders/seen.glsl");
const SURFACE: &str = include_str!("shaders/surface.frag");
const PAINTED: &str = include_str!("shaders/painted.frag");
const PLAIN: &str = include_str!("shaders/plain.frag");
const PLAN: &str = include_str!("shaders/plan.frag");
const PLAN_FLOOR: &str = include_str!("shaders/plan_floor.frag");
const NOTHING: &str = include_str!("shaders/nothing.frag");

/// The text that all shaders of a picture begin with; ROOM may be set before it.
fn light() -> String {
    format!(
        "#ifndef ROOM\n#define ROOM 0\n#endif\n\
         const float LAMP_HEIGHT = {LAMP_HEIGHT_M:?};\n\
         const float LAMP_APART = {LAMP_APART_M:?};\n\
         {LIGHT}"
    )
}

/// A program of a vertex shader and the parts of a fragment shader, with numbers that both know.
///
/// # Errors
/// The graphics card's compiler does not take it.
pub fn program(
    context: &Context,
    vertex: &str,
    set: &[(&str, u32)],
    fragment: &[&str],
) -> Result<Program, CoreError> {
    let set: String = set.iter().map(|(name, value)| format!("#define {name} {value}\n")).collect();
    let fragment = format!("{set}{}{}", light(), fragment.concat());
    Program::from_source(context, &format!("{set}{vertex}"), &fragment)
}

/// What every shader of a picture may want to know.
#[derive(Clone, Copy)]
pub struct Facts<'a> {
    /// Half the bed [m].
    pub bed: Vec2,
    /// The light of the room, if one is drawn.
    pub room: Option<&'a RoomLight>,
}

impl Facts<'_> {
    /// Tells a shader.
    pub fn tell(&self, program: &Program, viewer: &dyn Viewer) {
        program.use_uniform_if_required("eye", viewer.position());
        program.use_uniform_if_required("bed", self.bed);
        program.use_uniform_if_required("view_projection", viewer.projection() * viewer.view());
        if let Some(room) = self.room {
            room.tell(program);
        }
    }
}

/// How surfaces are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Finish {
    /// What the shader's SHADOWS is.
    pub shadows: u8,
    /// Nap and grain are drawn.
    pub has_detail: bool,
}

/// The shaders. The library keeps compiled programs by number, so each has its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shader {
    /// A part of table or room, of this kind.
    Surface(u16, Finish),
    /// A part of a table from the picture of it from above.
    Plan,
    /// The floor about it.
    PlanFloor,
    /// Coloured vertices.
    Painted,
    /// Lines and see-through balls.
    Plain,
    /// The same, shining through what lies before it.
    Over,
    /// Only the depth.
    Depth,
}

impl Shader {
    fn number(self) -> u16 {
        match self {
            Shader::Depth => 2,
            Shader::Painted => 3,
            Shader::Plain => 4,
            Shader::Over => 5,
            Shader::Plan => 6,
            Shader::PlanFloor => 7,
            Shader::Surface(kind, Finish { shadows, has_detail }) => {
                0x100 + kind + 0x20 * u16::from(shadows) + 0x80 * u16::from(has_detail)
            }
        }
    }

    /// Its text; whether there is a room is known when it is compiled, since a processor that draws
    /// would pay for both.
    fn text(self, has_room: bool) -> String {
        let light = format!("#define ROOM {}\n{}", u8::from(has_room), light());
        match self {
            Shader::Depth => NOTHING.into(),
            Shader::Plan => PLAN.into(),
            Shader::PlanFloor => PLAN_FLOOR.into(),
            Shader::Painted => format!("{light}{PAINTED}"),
            Shader::Plain | Shader::Over => format!("{light}{PLAIN}"),
            Shader::Surface(kind, Finish { shadows, has_detail }) => {
                let detail = u8::from(has_detail);
                format!(
                    "#define KIND {kind}\n#define SHADOWS {shadows}\n#define DETAIL {detail}\n\
                     {light}{SEEN}{SURFACE}"
                )
            }
        }
    }

    fn states(self) -> RenderStates {
        match self {
            Shader::Surface(..) | Shader::Plan | Shader::PlanFloor | Shader::Painted => {
                RenderStates { cull: Cull::Back, ..RenderStates::default() }
            }
            Shader::Depth => RenderStates {
                write_mask: WriteMask::DEPTH,
                cull: Cull::Back,
                ..RenderStates::default()
            },
            Shader::Plain | Shader::Over => RenderStates {
                write_mask: WriteMask::COLOR,
                blend: Blend::TRANSPARENCY,
                cull: Cull::Back,
                depth_test: if self == Shader::Over { DepthTest::Always } else { DepthTest::Less },
            },
        }
    }
}

/// A shader with what it is told for one draw call.
pub struct Told<'a> {
    /// Which.
    pub shader: Shader,
    /// Sets the shader's own uniforms.
    pub tell: &'a dyn Fn(&Program),
    /// What all shaders know.
    pub facts: Facts<'a>,
}

impl Material for Told<'_> {
    fn fragment_shader_source(&self, _: &[&dyn Light]) -> String {
        self.shader.text(self.facts.room.is_some())
    }

    fn id(&self) -> EffectMaterialId {
        EffectMaterialId(self.shader.number() + if self.facts.room.is_some() { 0x800 } else { 0 })
    }

    fn use_uniforms(&self, program: &Program, viewer: &dyn Viewer, _: &[&dyn Light]) {
        self.facts.tell(program, viewer);
        (self.tell)(program);
    }

    fn render_states(&self) -> RenderStates {
        self.shader.states()
    }

    fn material_type(&self) -> MaterialType {
        match self.shader {
            Shader::Plain | Shader::Over => MaterialType::Transparent,
            Shader::Surface(..)
            | Shader::Plan
            | Shader::PlanFloor
            | Shader::Painted
            | Shader::Depth => MaterialType::Opaque,
        }
    }
}
