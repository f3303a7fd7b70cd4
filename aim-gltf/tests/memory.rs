//! Peak memory of loading and measuring a file, counted by the allocator: at most four times the file's size. This is a
//! separate test binary because the allocator counts for the whole process.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use aim_character::{Measurement, PAPER_AXES, mannequin};
use aim_gltf::Document;
use peak_alloc::PeakAlloc;

#[global_allocator]
static COUNTED: PeakAlloc = PeakAlloc;

/// Returns the peak memory of loading and measuring a file, relative to the file's size.
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

/// Serialises the tests, since allocations of other threads would be counted, too.
static ALONE: Mutex<()> = Mutex::new(());

fn assert_at_most_four_times(files: &[PathBuf]) {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    for path in files {
        let share = share(path);
        eprintln!("{}: {share:.2}", path.display());
        assert!(share <= 4.0, "{} takes {share} times its size", path.display());
    }
}

#[test]
fn four_times_the_file_at_most() {
    let folder = std::env::temp_dir().join(format!("aim-memory-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let made = folder.join("mannequin.glb");
    std::fs::write(&made, mannequin(|_| PAPER_AXES).unwrap()).unwrap();
    assert_at_most_four_times(&[made]);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn four_times_the_file_of_a_real_character_at_most() {
    let rigs = std::env::var_os("AIM_RIGS").expect("AIM_RIGS names a folder of real characters");
    let rigs = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(rigs);
    let mut files: Vec<_> = std::fs::read_dir(rigs).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|end| end == "glb" || end == "gltf"));
    assert!(!files.is_empty(), "AIM_RIGS names a folder without characters");
    assert_at_most_four_times(&files);
}
