//! A finished picture as SVG or PNG. The PNG is rendered with embedded fonts, so that it does not depend on those of
//! the machine.

use std::str::FromStr;

use maud::{Markup, html};

use crate::failure::{Failure, Result};
use crate::words::{fixed, trimmed};

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u16,
    pub(crate) height: u16,
}

/// Allowed lengths of a side, pixels.
const SIDES: std::ops::RangeInclusive<u16> = 320..=8192;

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let side = |text: &str| text.parse().ok().filter(|side| SIDES.contains(side));
        let sides = text.split_once('x').and_then(|(width, height)| Some((side(width)?, side(height)?)));
        let (width, height) = sides.ok_or_else(|| {
            format!("expected WIDTHxHEIGHT in pixels, such as 1000x720, each {} to {}", SIDES.start(), SIDES.end())
        })?;
        Ok(Self { width, height })
    }
}

/// Size that everything is laid out for. Other sizes are scaled, and have additional room if their aspect ratio
/// differs.
const USUAL: [f64; 2] = [1000.0, 720.0];

impl Size {
    /// Returns width and height in units of the drawing, at least those of [`USUAL`].
    pub(super) fn units(self) -> [f64; 2] {
        let [width, height] = [f64::from(self.width), f64::from(self.height)];
        let scale = (width / USUAL[0]).min(height / USUAL[1]);
        [width / scale, height / scale]
    }
}

/// A finished picture.
pub(crate) struct PlotPicture {
    svg: String,
}

impl PlotPicture {
    /// Creates a picture from `content` in [units](Size::units), with a `title` and `description` for readers who
    /// cannot see it.
    pub(super) fn new(size: Size, title: &str, description: &str, content: &Markup) -> Self {
        let [width, height] = size.units();
        let drawing = html! {
            svg xmlns="http://www.w3.org/2000/svg" width=(size.width) height=(size.height)
                viewBox={ "0 0 " (trimmed(width, 4)) " " (trimmed(height, 4)) } role="img"
                font-family="DejaVu Sans, Verdana, sans-serif" font-size="13" fill="#1b2127" {
                title { (title) }
                desc { (description) }
                rect width="100%" height="100%" fill="#ffffff" {}
                (content)
            }
        };
        Self { svg: format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n", drawing.into_string()) }
    }

    /// Returns the SVG document.
    pub(crate) fn svg(&self) -> &str {
        &self.svg
    }

    /// Renders the picture as a PNG file.
    ///
    /// # Errors
    /// The picture is too large.
    #[cfg(feature = "pictures")]
    pub(crate) fn png(&self) -> Result<Vec<u8>> {
        use std::sync::Arc;

        use resvg::tiny_skia::{Pixmap, Transform};
        use resvg::usvg::{Options, Tree, fontdb};

        let fail = |problem: String| Failure::input(format!("cannot draw the picture as PNG: {problem}"));
        let mut fonts = fontdb::Database::new();
        for font in [dejavu::sans::regular(), dejavu::sans::bold()] {
            fonts.load_font_source(fontdb::Source::Binary(Arc::new(font)));
        }
        let options = Options { fontdb: Arc::new(fonts), ..Options::default() };
        let tree = Tree::from_str(&self.svg, &options).map_err(|error| fail(error.to_string()))?;
        let size = tree.size().to_int_size();
        let mut pixels = Pixmap::new(size.width(), size.height())
            .ok_or_else(|| fail("it is too large; give a smaller --size".into()))?;
        resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
        pixels.encode_png().map_err(|error| fail(error.to_string()))
    }

    /// Always fails: PNG needs the feature `pictures`.
    #[cfg(not(feature = "pictures"))]
    pub(crate) fn png(&self) -> Result<Vec<u8>> {
        Err(Failure::input(
            "this aim was built without PNG support; write an .svg, or rebuild it with the feature `pictures`: \
             cargo run --release --features pictures -- plot",
        ))
    }
}

/// Formats a coordinate of the picture.
pub(super) fn c(value: f64) -> String {
    trimmed(value, 2)
}

/// Returns the SVG path data of a polyline through `points`.
pub(super) fn path(points: &[[f64; 2]], closed: bool) -> String {
    let mut d = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        d += if k == 0 { "M" } else { "L" };
        d += &format!("{},{}", fixed(*x, 2), fixed(*y, 2));
    }
    if closed {
        d += "Z";
    }
    d
}

/// Draws text with a casing, so that it is readable on any background.
pub(super) fn cased(text: &str, [x, y]: [f64; 2], turned: f64, ink: &str, casing: &str) -> Markup {
    let turn = format!("rotate({} {} {})", c(turned), c(x), c(y));
    html! {
        text x=(c(x)) y=(c(y)) dy="4" transform=(turn) text-anchor="middle" font-size="11.5"
            fill=(ink) stroke=(casing) stroke-width="4" stroke-linejoin="round" paint-order="stroke" { (text) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read() {
        assert_eq!("800x600".parse(), Ok(Size { width: 800, height: 600 }));
        for wrong in ["", "800", "800x", "x600", "800x600x2", "0x600", "-800x600", "9000x600", "800X600", "1e3x600"] {
            assert!(wrong.parse::<Size>().expect_err(wrong).contains("WIDTHxHEIGHT"), "{wrong}");
        }
    }
}
