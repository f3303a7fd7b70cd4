//! Reads pictures back: the lines of a plot in units of its axes' labels, and the pixels of a PNG.

use aim_runtime::glam::DVec3;
use roxmltree::{Document, Node};

/// Plot read back from its SVG.
pub(crate) struct Plot<'a> {
    pub(crate) document: &'a Document<'a>,
    /// Heading and pitch as functions of the pixel position, each `value = a + b · position`.
    axes: [[f64; 2]; 2],
    /// Left, top, right and bottom of the panel, pixels.
    pub(crate) panel: [f64; 4],
}

pub(crate) fn number(text: &str) -> f64 {
    text.replace('−', "-").parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

pub(crate) fn attribute(node: Node<'_, '_>, name: &str) -> f64 {
    number(node.attribute(name).unwrap_or_else(|| panic!("no {name} in {node:?}")))
}

pub(crate) fn text(node: Node<'_, '_>) -> String {
    node.descendants().filter(Node::is_text).filter_map(|part| part.text()).collect()
}

pub(crate) fn classed<'a>(root: Node<'a, 'a>, class: &str) -> Vec<Node<'a, 'a>> {
    root.descendants().filter(|node| node.attribute("class") == Some(class)).collect()
}

/// Returns the polylines of a path with the commands `M`, `L` and `Z`.
pub(crate) fn lines(path: Node<'_, '_>) -> Vec<Vec<[f64; 2]>> {
    let d = path.attribute("d").expect("a path");
    let point = |text: &str| {
        let (x, y) = text.trim_end_matches('Z').split_once(',').expect("x,y");
        [number(x), number(y)]
    };
    d.split('M').skip(1).map(|line| line.split('L').map(point).collect()).collect()
}

impl<'a> Plot<'a> {
    pub(crate) fn read(document: &'a Document<'a>) -> Self {
        let axis = |class: &str, at: &str| {
            let ticks = classed(document.root(), class)[0];
            let ticks: Vec<[f64; 2]> = ticks
                .children()
                .filter(Node::is_element)
                .map(|tick| [attribute(tick, at), number(&text(tick))])
                .collect();
            let ([from, first], [to, last]) = (ticks[0], ticks[ticks.len() - 1]);
            let slope = (last - first) / (to - from);
            [first - slope * from, slope]
        };
        let mut axes = [axis("x-ticks", "x"), axis("y-ticks", "y")];
        // Labels are drawn slightly below their ticks.
        axes[1][0] += axes[1][1] * 4.5;
        let clip = document.descendants().find(|node| node.has_tag_name("clipPath"));
        let panel = clip.map_or([0.0; 4], |clip| {
            let [x, y, w, h] =
                ["x", "y", "width", "height"].map(|name| attribute(clip.first_child().expect("it"), name));
            [x, y, x + w, y + h]
        });
        Self { document, axes, panel }
    }

    pub(crate) fn angles(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.axes[k][0] + self.axes[k][1] * at[k])
    }

    /// Returns the elements of a class inside the panel.
    pub(crate) fn drawn(&self, class: &str) -> Vec<Node<'a, 'a>> {
        let panel = self.document.descendants().find(|node| node.has_attribute("clip-path"));
        classed(panel.expect("the panel"), class)
    }

    /// Returns the angles at the centre of a mark.
    pub(crate) fn place(&self, mark: Node<'_, '_>) -> [f64; 2] {
        self.angles(match mark.attribute("cx") {
            Some(_) => [attribute(mark, "cx"), attribute(mark, "cy")],
            None => ["x", "y"].map(|name| attribute(mark, name) + attribute(mark, "width") / 2.0),
        })
    }

    /// Returns the target's position from the line below the title.
    pub(crate) fn target(&self) -> DVec3 {
        let about = self.document.descendants().find_map(|node| Some(node.text()?.split_once("at (")?.1.to_owned()));
        let about = about.expect("a target");
        let point = about.split(')').next().expect("a point");
        DVec3::from_slice(&point.split(", ").map(number).collect::<Vec<f64>>())
    }
}

/// Pixels of a PNG.
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    channels: usize,
    bytes: Vec<u8>,
}

impl Picture {
    pub(crate) fn of(file: &[u8]) -> Self {
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut bytes).expect("pixels");
        let size = |side: u32| usize::try_from(side).expect("a side");
        Self { width: size(info.width), height: size(info.height), channels: info.color_type.samples(), bytes }
    }

    pub(crate) fn at(&self, x: f64, y: f64) -> [u8; 3] {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the picture")]
        let at = (y as usize * self.width + x as usize) * self.channels;
        [self.bytes[at], self.bytes[at + 1], self.bytes[at + 2]]
    }
}

/// Returns the largest residual of the best linear fit in four numbers per row.
pub(crate) fn worst_of_fit(rows: Vec<([f64; 4], f64)>) -> f64 {
    // Normal equations, with the columns scaled to equal size.
    let sizes = [0, 1, 2, 3].map(|k| rows.iter().map(|(row, _)| row[k].abs()).fold(1e-9, f64::max));
    let rows: Vec<([f64; 4], f64)> =
        rows.into_iter().map(|(row, at)| ([0, 1, 2, 3].map(|k| row[k] / sizes[k]), at)).collect();
    let mut system = [[0.0; 5]; 4];
    for (row, at) in &rows {
        for i in 0..4 {
            for j in 0..4 {
                system[i][j] += row[i] * row[j];
            }
            system[i][4] += row[i] * at;
        }
    }
    for pivot in 0..4 {
        let best =
            (pivot..4).max_by(|a, b| system[*a][pivot].abs().total_cmp(&system[*b][pivot].abs())).expect("a row");
        system.swap(pivot, best);
        let row = system[pivot];
        for (i, other) in system.iter_mut().enumerate() {
            if i != pivot {
                let part = other[pivot] / row[pivot];
                for (other, own) in other.iter_mut().zip(row) {
                    *other -= part * own;
                }
            }
        }
    }
    let factors = [0, 1, 2, 3].map(|k| system[k][4] / system[k][k]);
    let deviation = |(row, at): &([f64; 4], f64)| (row.iter().zip(factors).map(|(x, f)| x * f).sum::<f64>() - at).abs();
    rows.iter().map(deviation).fold(0.0, f64::max)
}
