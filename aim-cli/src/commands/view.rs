//! `aim view`: opens a window with a live character. The window is behind the feature `view`, so that a build without
//! it has fewer dependencies.

use crate::args;
use crate::failure::{Failure, Result};

#[cfg(not(feature = "view"))]
pub(super) fn run(_: args::View) -> Result {
    Err(Failure::input(
        "this aim was built without the viewer; rebuild it with the feature `view`, which needs Rust 1.92: cargo install \
         --path aim-cli --features view",
    ))
}

#[cfg(feature = "view")]
pub(super) fn run(arguments: args::View) -> Result {
    check_outputs(&arguments)?;
    if let Some(ended) = hidden::run(&arguments)? {
        return ended;
    }
    let told = aim_viewer::run(options(arguments)).map_err(Failure::input)?;
    if told.is_empty() { Ok(()) } else { crate::files::print(&format!("{told}\n")) }
}

/// Rejects a screenshot path that is an input file or does not end in `.png`.
#[cfg(feature = "view")]
fn check_outputs(arguments: &args::View) -> Result {
    let Some(out) = &arguments.screenshot else { return Ok(()) };
    if crate::files::ending(out) != "png" {
        return Err(Failure::in_file(out, "--screenshot writes a PNG picture; use a name that ends in .png"));
    }
    let read = [(arguments.file.as_ref(), "the model"), (arguments.rig.as_ref(), "the rig")];
    let mut outputs = crate::outputs::Outputs::reading(read);
    if let Some(file) = &arguments.file {
        outputs = outputs.reading_parts_of(&crate::files::load_model(file)?);
    }
    outputs.writes(out, "--screenshot")
}

#[cfg(feature = "view")]
fn options(arguments: args::View) -> aim_viewer::Options {
    use aim_viewer::{Lineup, Options, Path, Shot, Shown};
    use args::{Show, TargetPath};

    let shows = |what: Show| arguments.show.contains(&what);
    let mut options = Options::default();
    options.lineup = arguments.solver.map(|solvers| match solvers {
        [one] => Lineup::One(*one),
        _ => Lineup::All,
    });
    options.path = match arguments.path {
        TargetPath::Still => Path::Still,
        TargetPath::Orbit => Path::Orbit,
        TargetPath::Eight => Path::Eight,
        TargetPath::Noise => Path::Noise,
    };
    options.shown = Shown {
        axes: shows(Show::Axes),
        gaze: shows(Show::Gaze),
        limits: shows(Show::Limits),
        boxes: shows(Show::Boxes),
        lamp: shows(Show::Lamp),
        feet: shows(Show::Slope),
        trail: shows(Show::Trail),
        plots: shows(Show::Plots),
        timing: shows(Show::Timing),
        panel: shows(Show::Panel),
        dark: !arguments.light,
    };
    options.crowd = arguments.crowd.into();
    let (frames, size) = (arguments.frames, [arguments.size.width, arguments.size.height].map(u32::from));
    options.shot = arguments.screenshot.map(|out| Shot { out, frames, size, json: arguments.json });
    options.file = arguments.file;
    options.rig = arguments.rig;
    options.clip = arguments.clip;
    options
}

/// Screenshots on a virtual X display, so that they need no real one.
#[cfg(feature = "view")]
mod hidden {
    use std::process::Command;

    use super::{Failure, Result, args};
    use crate::plot::Size;

    /// Environment variable that is set in the process on the virtual display.
    const HIDDEN: &str = "AIM_VIEW_HIDDEN";

    /// Runs this command again on a virtual display and returns its result. `None` if it should run in this process:
    /// without `--screenshot`, on other systems than Linux, on the virtual display itself, or if `xvfb-run` cannot be
    /// started and there is a display.
    ///
    /// Ends the process with code 2 if the other one failed.
    pub(super) fn run(arguments: &args::View) -> Result<Option<Result>> {
        if arguments.screenshot.is_none() || !cfg!(target_os = "linux") || std::env::var_os(HIDDEN).is_some() {
            return Ok(None);
        }
        let Size { width, height } = arguments.size;
        let program = std::env::current_exe()
            .map_err(|error| Failure::input(format!("cannot find the path of this executable: {error}")))?;
        let status = Command::new("xvfb-run")
            .args(["--auto-servernum", "--server-args"])
            .arg(format!("-screen 0 {width}x{height}x24"))
            .arg(program)
            .args(std::env::args_os().skip(1))
            .env(HIDDEN, "1")
            // One logical point is one pixel on the virtual display.
            .env("WINIT_X11_SCALE_FACTOR", "1")
            .env_remove("WAYLAND_DISPLAY")
            .status();
        let has_display = ["DISPLAY", "WAYLAND_DISPLAY"].iter().any(|name| std::env::var_os(name).is_some());
        match status {
            Ok(status) if status.success() => Ok(Some(Ok(()))),
            // The other process has printed the reason.
            Ok(_) => std::process::exit(2),
            Err(_) if has_display => Ok(None),
            Err(_) => {
                Err(Failure::input("no display; install xvfb, whose xvfb-run provides a virtual one, or set DISPLAY"))
            }
        }
    }
}
