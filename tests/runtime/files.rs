//! Files: sizes, kinds, writing whole.

use super::cli::folder;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::{keep_newest, load_scene, read_text, write_whole};
use std::fs;

#[test]
fn what_is_written_appears_whole_and_leaves_no_draft() {
    let folder = folder("write_whole");
    let file = folder.join("deep/er/a.txt");
    write_whole(&file, b"one").unwrap();
    write_whole(&file, b"two").unwrap();
    assert_eq!(fs::read_to_string(&file).unwrap(), "two");
    assert_eq!(fs::read_dir(file.parent().unwrap()).unwrap().count(), 1);
    assert!(matches!(write_whole(&folder, b"x"), Err(Error::Write { .. })));
}

#[test]
fn reading_is_bounded_and_only_reads_plain_text_files() {
    let folder = folder("read_text");
    let file = folder.join("a.txt");
    fs::write(&file, "12345").unwrap();
    assert_eq!(read_text(&file, 5).unwrap(), "12345");
    assert!(matches!(read_text(&file, 4), Err(Error::TooLarge { limit: 4, .. })));
    assert!(matches!(read_text(&folder, 9), Err(Error::NoFile { .. })));
    assert!(matches!(read_text(&folder.join("none"), 9), Err(Error::Read { .. })));
    fs::write(&file, [0xff, 0xfe]).unwrap();
    assert!(matches!(read_text(&file, 9), Err(Error::NoText { .. })));
}

#[test]
fn a_mesh_is_read_from_the_scenes_folder_and_from_nowhere_else() {
    let folder = folder("meshes");
    let scene = "[scene]\nname = \"x\"\n[physics]\n[[mesh]]\nfile = \"course/a.obj\"\n";
    let file = folder.join("s.toml");
    fs::write(&file, scene).unwrap();
    write_whole(&folder.join("course/a.obj"), b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let loaded = load_scene(file.to_str().unwrap()).unwrap();
    let table = loaded.scene.build_table(&mut |name| loaded.read_mesh(name)).unwrap();
    assert_eq!(table.mesh.faces.len(), 1);
    for outside in ["../s.toml", "course/../../x", file.to_str().unwrap()] {
        assert!(loaded.read_mesh(outside).unwrap_err().contains("below it"), "{outside}");
    }
}

#[test]
fn only_the_newest_recordings_are_kept() {
    let folder = folder("keep");
    for name in ["1.jsonl", "3.jsonl", "2.jsonl", "0.txt"] {
        fs::write(folder.join(name), "").unwrap();
    }
    keep_newest(&folder, 2).unwrap();
    let mut left: Vec<String> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    left.sort();
    assert_eq!(left, ["0.txt", "2.jsonl", "3.jsonl"]);
}
