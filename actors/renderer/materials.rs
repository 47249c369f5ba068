//! Shaders as materials: each one a text, its render states and what it is told.

use super::room_light::RoomLight;
use three_d::*;

/// The light that all shaders share.
pub const LIGHT: &str = include_str!("shaders/light.glsl");
const SURFACE: &str = include_str!("shaders/surface.frag");
const BALL: &str = include_str!("shaders/ball.frag");
const SHADOW: &str = include_str!("shaders/shadow.frag");
const PAINTED: &str = include_str!("shaders/painted.frag");
const PLAIN: &str = include_str!("shaders/plain.frag");

/// The shaders. The library keeps compiled programs by number, so each has its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shader {
    /// A part of table or room, of this kind.
    Surface(u16),
    /// A ball.
    Ball,
    /// A ball's shadow.
    Shadow,
    /// Coloured vertices.
    Painted,
    /// Lines and see-through balls.
    Plain,
    /// The same, shining through what lies before it.
    Over,
}

impl Shader {
    fn number(self) -> u16 {
        match self {
            Shader::Ball => 1,
            Shader::Shadow => 2,
            Shader::Painted => 3,
            Shader::Plain => 4,
            Shader::Over => 5,
            Shader::Surface(kind) => 0x100 + kind,
        }
    }

    /// Its text; whether there is a room is known when it is compiled, since a processor that draws
    /// would pay for both.
    fn text(self, has_room: bool) -> String {
        let text = match self {
            Shader::Ball => format!("{LIGHT}{BALL}"),
            Shader::Shadow => format!("{LIGHT}{SHADOW}"),
            Shader::Painted => format!("{LIGHT}{PAINTED}"),
            Shader::Plain | Shader::Over => format!("{LIGHT}{PLAIN}"),
            Shader::Surface(kind) => format!("#define KIND {kind}\n{LIGHT}{SURFACE}"),
        };
        format!("#define ROOM {}\n{text}", u8::from(has_room))
    }

    fn states(self) -> RenderStates {
        match self {
            Shader::Surface(_) | Shader::Ball | Shader::Painted => {
                RenderStates { cull: Cull::Back, ..RenderStates::default() }
            }
            Shader::Shadow | Shader::Plain | Shader::Over => RenderStates {
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
    /// Half the bed [m].
    pub bed: Vec2,
    /// The light of the room.
    pub room: &'a RoomLight,
}

impl Material for Told<'_> {
    fn fragment_shader_source(&self, _: &[&dyn Light]) -> String {
        self.shader.text(self.room.is_there())
    }

    fn id(&self) -> EffectMaterialId {
        EffectMaterialId(self.shader.number() + if self.room.is_there() { 0x800 } else { 0 })
    }

    fn use_uniforms(&self, program: &Program, viewer: &dyn Viewer, _: &[&dyn Light]) {
        program.use_uniform_if_required("eye", viewer.position());
        program.use_uniform_if_required("bed", self.bed);
        self.room.tell(program);
        (self.tell)(program);
    }

    fn render_states(&self) -> RenderStates {
        self.shader.states()
    }

    fn material_type(&self) -> MaterialType {
        match self.shader {
            Shader::Shadow | Shader::Plain | Shader::Over => MaterialType::Transparent,
            Shader::Surface(_) | Shader::Ball | Shader::Painted => MaterialType::Opaque,
        }
    }
}
