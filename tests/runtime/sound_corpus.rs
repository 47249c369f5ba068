#[path = "../fuzz/sounds.rs"]
mod sounds;

use std::fs;
use std::path::Path;

#[test]
fn every_sound_file_of_the_corpus_is_taken_or_refused() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests");
    let mut count = 0;
    for entry in fs::read_dir(tests.join("fuzz/coverage/corpus/sounds")).unwrap() {
        let path = entry.unwrap().path();
        // The name of the file that fails is the last one told.
        println!("{}", path.display());
        sounds::run(&fs::read(&path).unwrap());
        count += 1;
    }
    assert!(count > 10, "{count}");
}
