use aim::differentiate;

#[differentiate]
mod functions {
    /// `flatten` copies the rows.
    #[differentiate(wrt(x))]
    fn flattened(x: f32) -> f32 {
        let mut planes = [[[x, 1.0]]];
        for row in planes.iter_mut().flatten() {
            row[0] += 10.0;
        }
        planes[0][0][0]
    }

    fn larger(one: &mut [f32; 1], other: &mut [f32; 1]) {
        let larger = if one[0] > other[0] { one } else { other };
        larger[0] += 10.0;
    }

    #[differentiate(wrt(x))]
    fn chosen(x: f32) -> f32 {
        let (mut a, mut b) = ([x], [2.0]);
        larger(&mut a, &mut b);
        a[0] + b[0]
    }

    struct Holder<'a> {
        values: &'a mut [f32; 2],
    }

    impl Holder<'_> {
        fn add(&mut self) {
            self.values[0] += 10.0;
        }
    }

    #[differentiate(wrt(x))]
    fn held(x: f32) -> f32 {
        let mut values = [x, 1.0];
        let mut holder = Holder { values: &mut values };
        holder.add();
        values[0]
    }

    struct Mesh<'a> {
        heights: &'a [f32],
        scale: f32,
    }

    #[differentiate(wrt(mesh))]
    fn by_slice(mesh: Mesh<'_>) -> f32 {
        mesh.heights[0] * mesh.scale
    }
}

fn main() {}
