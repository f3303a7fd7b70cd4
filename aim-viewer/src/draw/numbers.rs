//! Data textures: arrays of numbers for vertex shaders.

use three_d::{Context, Interpolation, Texture2D, Wrapping};

/// Texels per row: a width that every OpenGL 3.3 and WebGL 2 supports.
const COLUMNS: u32 = 1024;

/// Creates a texture with these texels, row by row. It has at least one row, and the last is padded with zeros.
pub(super) fn texture(context: &Context, texels: &[[f32; 4]]) -> Texture2D {
    let (texels, rows) = filled(texels);
    let (filter, wrap) = (Interpolation::Nearest, Wrapping::ClampToEdge);
    let texture = Texture2D::new_empty::<[f32; 4]>(context, COLUMNS, rows, filter, filter, None, wrap, wrap);
    texture.fill(&texels);
    texture
}

/// Writes the texels to an existing texture if it has the right size; otherwise replaces it.
pub(super) fn fill(context: &Context, kept: &mut Option<Texture2D>, texels: &[[f32; 4]]) {
    let (filled, rows) = filled(texels);
    match kept {
        Some(texture) if texture.height() == rows => texture.fill(&filled),
        _ => *kept = Some(texture(context, texels)),
    }
}

fn filled(texels: &[[f32; 4]]) -> (Vec<[f32; 4]>, u32) {
    let rows = texels.len().div_ceil(COLUMNS as usize).max(1);
    let mut texels = texels.to_vec();
    texels.resize(rows * COLUMNS as usize, [0.0; 4]);
    (texels, u32::try_from(rows).unwrap_or(u32::MAX))
}
