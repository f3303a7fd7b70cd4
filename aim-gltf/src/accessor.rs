//! Reads accessor data as `f32`s. Every range is validated with checked arithmetic before any byte is read.

use core::cell::Cell;

use crate::error::Error;
use crate::raw::{Accessor, BufferView, Raw};

/// Maximum number of elements of an accessor without a buffer view, whose zeros are allocated without any bytes in the
/// file.
const MAX_IMPLIED: usize = 1 << 24;

/// The document's typed parts and the bytes of its buffers.
pub(crate) struct Data<'a> {
    pub(crate) raw: &'a Raw,
    pub(crate) buffers: &'a [Option<&'a [u8]>],
    /// Budget: count of numbers that may still be decoded.
    budget: Cell<usize>,
}

pub(crate) fn components(shape: &str) -> Option<usize> {
    Some(match shape {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => return None,
    })
}

pub(crate) fn size_of(component_type: u32) -> Option<usize> {
    Some(match component_type {
        5120 | 5121 => 1,
        5122 | 5123 => 2,
        5125 | 5126 => 4,
        _ => return None,
    })
}

/// Decodes one component. Normalised integers map to 0…1 or −1…1, as specified.
#[expect(clippy::cast_precision_loss, reason = "indices above 2^24 never pass through here as floats that matter")]
fn component(bytes: &[u8], component_type: u32, normalized: bool) -> f32 {
    let scaled = |value: f32, largest: f32| {
        if normalized { (value / largest).max(-1.0) } else { value }
    };
    match (component_type, bytes) {
        (5120, &[a]) => scaled(f32::from(i8::from_le_bytes([a])), 127.0),
        (5121, &[a]) => scaled(f32::from(a), 255.0),
        (5122, &[a, b]) => scaled(f32::from(i16::from_le_bytes([a, b])), 32767.0),
        (5123, &[a, b]) => scaled(f32::from(u16::from_le_bytes([a, b])), 65535.0),
        (5125, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]) as f32,
        (5126, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
        _ => 0.0,
    }
}

impl<'a> Data<'a> {
    pub(crate) fn new(raw: &'a Raw, buffers: &'a [Option<&'a [u8]>]) -> Self {
        // Sharing accessors is legitimate, but a small file must not allocate without bound by referring to one a
        // million times.
        let bytes: usize = buffers.iter().flatten().map(|b| b.len()).sum();
        let budget = Cell::new(bytes.saturating_mul(64).saturating_add(4 * MAX_IMPLIED));
        Self { raw, buffers, budget }
    }

    /// The number of morph targets of a mesh.
    pub(crate) fn target_count(&self, mesh: usize) -> usize {
        self.raw.meshes[mesh].primitives.first().and_then(|first| first.targets.as_array()).map_or(0, Vec::len)
    }

    /// Returns the bytes of a buffer view, and the view.
    fn view(&self, index: usize, place: &str) -> Result<(&'a [u8], &'a BufferView), Error> {
        let view = self.raw.views.get(index);
        let view = view.ok_or_else(|| Error::invalid(place, format!("bufferViews[{index}] does not exist")))?;
        let (place, number) = (format!("bufferViews[{index}]"), view.buffer);
        let buffer = self.buffers.get(number);
        let buffer = buffer.ok_or_else(|| Error::invalid(&*place, format!("buffers[{number}] does not exist")))?;
        let bytes = buffer.ok_or_else(|| Error::NoData {
            place: format!("buffers[{number}]"),
            problem: "its bytes are not in the file (compressed by an extension?); export without compression".into(),
        })?;
        let (start, length, all) = (view.byte_offset, view.byte_length, bytes.len());
        let range = start.checked_add(length).map(|end| start..end);
        let bytes = range.and_then(|range| bytes.get(range)).ok_or_else(|| {
            Error::invalid(place, format!("{length} bytes from byte {start} do not fit into a buffer of {all} bytes"))
        })?;
        Ok((bytes, view))
    }

    /// Returns the raw bytes of a buffer view.
    pub(crate) fn bytes(&self, index: usize, place: &str) -> Result<&'a [u8], Error> {
        self.view(index, place).map(|(bytes, _)| bytes)
    }

    /// Returns `count` elements of `size` bytes each, starting at `offset` in a view, at the view's stride.
    fn elements(
        &self,
        view: usize,
        offset: usize,
        size: usize,
        count: usize,
        place: &str,
    ) -> Result<impl Iterator<Item = &'a [u8]>, Error> {
        let (bytes, info) = self.view(view, place)?;
        let stride = info.byte_stride.filter(|stride| *stride != 0).unwrap_or(size);
        if stride < size {
            let problem = format!("{stride} is less than the {size} bytes of an element of {place}");
            return Err(Error::invalid(format!("bufferViews[{view}].byteStride"), problem));
        }
        let last = count.saturating_sub(1).checked_mul(stride);
        let end = last.and_then(|n| n.checked_add(size)).and_then(|n| n.checked_add(offset));
        if count > 0 && end.is_none_or(|end| end > bytes.len()) {
            let all = bytes.len();
            let problem =
                format!("{count} elements from byte {offset} do not fit into bufferViews[{view}] of {all} bytes");
            return Err(Error::invalid(place, problem));
        }
        Ok((0..count).map(move |k| &bytes[offset + k * stride..offset + k * stride + size]))
    }

    fn charge_budget(&self, numbers: usize, place: &str) -> Result<(), Error> {
        let left = self.budget.get().checked_sub(numbers);
        let left = left.ok_or_else(|| {
            Error::invalid(place, "the file reuses accessors so often that its data would not fit into memory")
        })?;
        self.budget.set(left);
        Ok(())
    }

    /// Returns the accessor at `index`, or an error if it does not exist.
    pub(crate) fn accessor(&self, index: usize, place: &str) -> Result<&'a Accessor, Error> {
        self.raw.accessors.get(index).ok_or_else(|| Error::invalid(place, format!("accessors[{index}] does not exist")))
    }

    /// Decodes all components of all elements into one flat vector. `shapes` are the accessor types allowed at `place`.
    pub(crate) fn floats(&self, index: usize, shapes: &[&str], place: &str) -> Result<Vec<f32>, Error> {
        let accessor = self.accessor(index, place)?;
        let at = format!("accessors[{index}]");
        if !shapes.contains(&accessor.shape.as_str()) {
            let problem = format!("its type is {:?}, and {place} needs {}", accessor.shape, shapes.join(" or "));
            return Err(Error::invalid(at, problem));
        }
        let width = components(&accessor.shape).unwrap_or(1);
        let part = size_of(accessor.component_type)
            .ok_or_else(|| Error::invalid(&at, format!("component type {} is unknown", accessor.component_type)))?;
        let decode = |bytes: &[u8], out: &mut Vec<f32>| {
            out.extend(bytes.chunks_exact(part).map(|c| component(c, accessor.component_type, accessor.normalized)));
        };
        let mut out = Vec::new();
        if let Some(view) = accessor.buffer_view {
            // `elements` has checked that all elements lie inside the buffer, which bounds the capacity.
            let elements = self.elements(view, accessor.byte_offset, width * part, accessor.count, &at)?;
            self.charge_budget(accessor.count.saturating_mul(width), &at)?;
            out.reserve(accessor.count * width);
            elements.for_each(|bytes| decode(bytes, &mut out));
        } else {
            if accessor.count > MAX_IMPLIED {
                let problem = format!("{} elements without a buffer view are implausibly many", accessor.count);
                return Err(Error::invalid(at, problem));
            }
            self.charge_budget(accessor.count * width, &at)?;
            out.resize(accessor.count * width, 0.0);
        }
        if let Some(sparse) = &accessor.sparse {
            let kind = sparse.indices.component_type;
            let Some(index_size) = size_of(kind).filter(|_| matches!(kind, 5121 | 5123 | 5125)) else {
                let problem = format!("component type {kind} is not valid for indices");
                return Err(Error::invalid(format!("{at}.sparse.indices"), problem));
            };
            let (indices, values) = (&sparse.indices, &sparse.values);
            let place = format!("{at}.sparse");
            let indices = self.elements(indices.buffer_view, indices.byte_offset, index_size, sparse.count, &place)?;
            let values = self.elements(values.buffer_view, values.byte_offset, width * part, sparse.count, &place)?;
            let mut element = Vec::with_capacity(width);
            for (target, value) in indices.zip(values) {
                let target = target.iter().rev().fold(0_usize, |n, byte| n << 8 | usize::from(*byte));
                let slot = target.checked_mul(width).and_then(|start| out.get_mut(start..start + width));
                let slot = slot.ok_or_else(|| Error::invalid(&place, format!("element {target} does not exist")))?;
                element.clear();
                decode(value, &mut element);
                slot.copy_from_slice(&element);
            }
        }
        if let Some(bad) = out.iter().position(|value| !value.is_finite()) {
            return Err(Error::invalid(at, format!("element {} is not a finite number", bad / width)));
        }
        Ok(out)
    }
}
