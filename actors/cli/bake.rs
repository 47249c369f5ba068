//! `hapticbillard bake`: the light of the rooms.

use super::Status;
use clap::Args;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;
#[cfg(feature = "renderer")]
use {
    super::{json_line, progress},
    glam::Vec3,
    hapticbillard::room::{BakedFor, Baker, Pass, Room},
    hapticbillard::shipped,
    hapticbillard::table::Table,
    hapticbillard_actors::files::{read_if_there, write_whole},
    hapticbillard_actors::renderer::encode_light,
    indicatif::ProgressBar,
    rayon::prelude::*,
    std::collections::BTreeMap,
    std::time::Instant,
};

const EXAMPLE: &str = "\
Every table throws its own shadow and its own green light, so each has a light map: a PNG picture
whose channels are the square root of the light. light.toml beside them says for which room and with
how many rays each was baked; a game takes only a map that was baked for the room that it draws.

Examples:
  hapticbillard bake --out light --quick
  hapticbillard bake --out light --table pool-9ft --samples 512";

/// Computes the light in the room round each table, over several bounces, into pictures.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct BakeArgs {
    /// The folder; it is made if it is not there.
    #[arg(long, value_name = "FOLDER", default_value = "light")]
    pub out: PathBuf,

    /// Rays per texel and bounce.
    #[arg(long, value_name = "N", default_value = "128")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub samples: u32,

    /// A first look: 16 rays.
    #[arg(long, conflicts_with = "samples")]
    pub quick: bool,

    /// Only these tables, in place of all that are shipped.
    #[arg(long, value_name = "NAME,NAME", value_delimiter = ',', num_args = 1)]
    pub table: Vec<String>,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// The list beside the pictures.
#[cfg(feature = "renderer")]
const LIST: &str = "light.toml";
/// Its most bytes.
#[cfg(feature = "renderer")]
const LIST_BYTES_MAX: u64 = 1 << 20;
/// How many texels are computed between two looks at the clock.
#[cfg(feature = "renderer")]
const PIECE: usize = 4096;
/// Rays of a first look.
#[cfg(feature = "renderer")]
const QUICK: u32 = 16;

/// What was baked.
#[cfg(feature = "renderer")]
#[derive(serde::Serialize)]
struct Row {
    table: String,
    room: String,
    samples: u32,
    texels: usize,
    width: u32,
    height: u32,
    bytes: usize,
    seconds: f64,
}

/// Bakes.
#[cfg(feature = "renderer")]
pub fn run(args: &BakeArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let names: Vec<&str> = match args.table.is_empty() {
        true => shipped::TABLES.iter().map(|(name, _)| *name).collect(),
        false => args.table.iter().map(String::as_str).collect(),
    };
    let samples = if args.quick { QUICK } else { args.samples };
    let mut rooms = Vec::new();
    for name in names {
        let fix = "name tables that are shipped";
        let table = Table::preset(name)
            .map_err(|error| Error::input("bake --table", error.to_string(), fix))?;
        let room = Room::around(&table)
            .ok_or_else(|| Error::input("bake --table", "this table has no room", fix))?;
        rooms.push((name, room));
    }
    // What was baked before stays; a list that cannot be read is that of another program.
    let path = args.out.join(LIST);
    let text = read_if_there(&path, LIST_BYTES_MAX)?.unwrap_or_default();
    let mut list = BakedFor::list(&text).map_err(|error| {
        let fix = "move it away, or bake into another folder";
        Error::input(path.display().to_string(), error.message(), fix)
    })?;
    let bar = progress(rooms.len() as u64 * Pass::all().count() as u64 * 100, "light");
    for (name, room) in &rooms {
        let row = bake(name, room, samples, &args.out, &bar)?;
        list.insert((*name).to_owned(), BakedFor { room: row.room.clone(), samples });
        write_whole(&path, listed(&list).as_bytes())?;
        if args.json {
            json_line(out, &row)?;
        } else {
            let Row { texels, bytes, seconds, .. } = &row;
            writeln!(out, "{name}: {texels} texels, {bytes} bytes, {seconds:.1} s")?;
        }
    }
    bar.finish_and_clear();
    if args.json {
        json_line(out, &serde_json::json!({ "summary": { "maps": rooms.len() } }))?;
    }
    Ok(Status::Success)
}

/// Bakes one room and writes its map.
#[cfg(feature = "renderer")]
fn bake(
    name: &str,
    room: &Room,
    samples: u32,
    folder: &std::path::Path,
    bar: &ProgressBar,
) -> Result<Row, Error> {
    let begun = Instant::now();
    let mut baker = Baker::new(&room.surfaces, samples);
    let count = baker.texels();
    for pass in Pass::all() {
        let mut light: Vec<(Vec3, f32)> = Vec::with_capacity(count);
        let before = bar.position();
        while light.len() < count {
            let piece = light.len()..(light.len() + PIECE).min(count);
            light.par_extend(piece.into_par_iter().map(|k| baker.light(pass, k)));
            bar.set_position(before + light.len() as u64 * 100 / count as u64);
        }
        baker.take(pass, &light);
    }
    let map = baker.finish(room);
    let path = folder.join(format!("{name}.png"));
    let picture = encode_light(&map).map_err(|error| Error::Write {
        path: path.clone(),
        reason: std::io::Error::other(error),
    })?;
    write_whole(&path, &picture)?;
    Ok(Row {
        table: name.to_owned(),
        room: room.digest().to_string(),
        samples,
        texels: count,
        width: map.size[0],
        height: map.size[1],
        bytes: picture.len(),
        seconds: begun.elapsed().as_secs_f64(),
    })
}

/// The list as TOML.
#[cfg(feature = "renderer")]
fn listed(list: &BTreeMap<String, BakedFor>) -> String {
    let mut text = String::from("# What the light maps were baked for; `make light` bakes anew.\n");
    for (name, BakedFor { room, samples }) in list {
        text += &format!("\n[{name}]\nroom = \"{room}\"\nsamples = {samples}\n");
    }
    text
}

/// Says that there is nothing to write pictures with.
#[cfg(not(feature = "renderer"))]
pub fn run(_: &BakeArgs, _: &mut dyn Write) -> Result<Status, Error> {
    let fix = "build it with the feature `renderer`, which is there by default";
    Err(Error::input("bake", "this build writes no pictures", fix))
}
