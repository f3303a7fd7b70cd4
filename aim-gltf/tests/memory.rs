//! How much memory loading and measuring take, counted by the allocator: at most four times the file.

use std::path::Path;

use aim_gltf::{Document, Measurement, PAPER_AXES, mannequin};
use peak_alloc::PeakAlloc;

#[global_allocator]
static COUNTED: PeakAlloc = PeakAlloc;

/// The most bytes in use at once while a file is loaded and measured, as a share of the file.
fn share(path: &Path) -> f64 {
    let before = COUNTED.current_usage();
    COUNTED.reset_peak_usage();
    let measured = Measurement::of(&Document::load(path).unwrap());
    let highest = COUNTED.peak_usage();
    assert!(!measured.bones.is_empty(), "{}", path.display());
    let file = usize::try_from(path.metadata().unwrap().len()).unwrap();
    #[expect(clippy::cast_precision_loss, reason = "files here are a few megabytes")]
    let share = (highest - before) as f64 / file as f64;
    share
}

#[test]
fn four_times_the_file_at_most() {
    let folder = std::env::temp_dir().join(format!("aim-memory-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let made = folder.join("mannequin.glb");
    std::fs::write(&made, mannequin(|_| PAPER_AXES).unwrap()).unwrap();
    let mut files = vec![made];
    match std::env::var_os("AIM_RIGS") {
        Some(rigs) => {
            let rigs = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(rigs);
            files.extend(std::fs::read_dir(rigs).unwrap().map(|entry| entry.unwrap().path()));
            files.retain(|path| path.extension().is_some_and(|end| end == "glb" || end == "gltf"));
        }
        None => eprintln!("only the mannequin: set AIM_RIGS to the folder of real characters"),
    }
    for path in &files {
        let share = share(path);
        eprintln!("{}: {share:.2}", path.display());
        assert!(share <= 4.0, "{} takes {share} times its size", path.display());
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
