//! Documents made from bones instead of a file.

use aim_animation::Skeleton;
use aim_animation::glam::Affine3A;
use serde_json::{Value, json};

use crate::document::{Document, DocumentParts, no_clips};
use crate::error::Error;
use crate::raw::{self, Raw};

impl Document {
    /// Makes a document from bones alone. For characters loaded by another program, so that they can be measured, get a
    /// proposed rig and be aimed like characters from files.
    ///
    /// `inverse_binds` are the inverse bind matrices used for skinning, bone space ← mesh space, one for each bone in
    /// the skeleton's order; `None` for bones that move no mesh. The document's nodes are the bones, in the same order.
    /// [`with_clips`](Self::with_clips) writes it as a file.
    ///
    /// # Errors
    /// [`Error::Bones`] if the number of matrices differs from the number of bones, or if one is not finite.
    ///
    /// ```
    /// use aim_animation::glam::{Affine3A, Vec3};
    /// use aim_animation::{Bone, Skeleton, Transform};
    /// use aim_gltf::Document;
    ///
    /// let up = |y| Transform::from_translation(Vec3::Y * y);
    /// let bones = [Bone::new("Spine", None).with_rest(up(1.2)), Bone::new("Head", Some(0)).with_rest(up(0.4))];
    /// let skeleton = Skeleton::new(bones)?;
    /// let binds = [1.2, 1.6].map(|y| Some(Affine3A::from_translation(Vec3::Y * -y)));
    /// let document = Document::of_bones(&skeleton, &binds)?;
    /// assert_eq!(document.skeleton().names(), skeleton.names());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_bones(skeleton: &Skeleton, inverse_binds: &[Option<Affine3A>]) -> Result<Self, Error> {
        let count = skeleton.len();
        if inverse_binds.len() != count {
            let found = inverse_binds.len();
            return Err(Error::Bones(format!("{found} inverse binds for {count} bones, expected one each, or `None`")));
        }
        let is_wild = |bind: &Option<Affine3A>| bind.is_some_and(|bind| !bind.is_finite());
        if let Some(bone) = inverse_binds.iter().position(is_wild) {
            let name = &skeleton.names()[bone];
            return Err(Error::Bones(format!("the inverse bind of bone {bone}, \"{name}\", is not finite")));
        }
        let (roots, children) = children(skeleton);
        let node = |(bone, children): (usize, Vec<usize>)| {
            let rest = &skeleton.rest()[bone];
            raw::Node {
                name: Some(skeleton.names()[bone].clone()),
                children,
                translation: Some(rest.translation.to_array().map(f64::from)),
                rotation: Some(rest.rotation.to_array().map(f64::from)),
                scale: Some(rest.scale.to_array().map(f64::from)),
                ..raw::Node::default()
            }
        };
        let mut raw = Raw {
            nodes: children.into_iter().enumerate().map(node).collect(),
            scenes: vec![raw::Scene { nodes: roots }],
            ..Raw::default()
        };
        let joints: Vec<usize> = (0..count).filter(|bone| inverse_binds[*bone].is_some()).collect();
        let mut chunk = None;
        if !joints.is_empty() {
            let maps = inverse_binds.iter().flatten().flat_map(|bind| {
                let [x, y, z] =
                    [bind.matrix3.x_axis, bind.matrix3.y_axis, bind.matrix3.z_axis].map(|axis| axis.extend(0.0));
                [x, y, z, bind.translation.extend(1.0)]
            });
            let bytes: Vec<u8> = maps.flat_map(|column| column.to_array()).flat_map(f32::to_le_bytes).collect();
            let (count, byte_length) = (joints.len(), bytes.len());
            raw.skins.push(raw::Skin { joints, inverse_bind_matrices: Some(0) });
            raw.accessors.push(raw::Accessor::of_floats(0, count, "MAT4"));
            raw.views.push(raw::BufferView { buffer: 0, byte_offset: 0, byte_length, byte_stride: None });
            raw.buffers.push(raw::Buffer { byte_length, uri: None });
            chunk = Some(bytes);
        }
        Self::of_parts(DocumentParts { raw, extensions: Value::Null, text: None, chunk, folder: None }, no_clips)
    }
}

/// Returns the bones without a parent, and the children of each bone.
fn children(skeleton: &Skeleton) -> (Vec<usize>, Vec<Vec<usize>>) {
    let (mut roots, mut children) = (Vec::new(), vec![Vec::new(); skeleton.len()]);
    for (bone, parent) in skeleton.parents().iter().enumerate() {
        parent.map_or(&mut roots, |parent| &mut children[parent]).push(bone);
    }
    (roots, children)
}

/// Generates the JSON of a document made from bones.
pub(crate) fn bones_as_json(document: &Document) -> Value {
    let skeleton = document.skeleton();
    let (roots, children) = children(skeleton);
    let node = |(bone, children): (usize, &Vec<usize>)| {
        let (name, rest) = (&skeleton.names()[bone], &skeleton.rest()[bone]);
        let mut node = json!({
            "name": name,
            "translation": rest.translation.to_array(),
            "rotation": rest.rotation.to_array(),
            "scale": rest.scale.to_array(),
        });
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        node
    };
    let nodes: Vec<Value> = children.iter().enumerate().map(node).collect();
    let mut text = json!({ "asset": { "version": "2.0" } });
    if !nodes.is_empty() {
        text["scene"] = json!(0);
        text["scenes"] = json!([{ "nodes": roots }]);
        text["nodes"] = json!(nodes);
    }
    if let Some(bytes) = document.binary_chunk() {
        let (joints, _) = skeleton.skin(0);
        text["skins"] = json!([{ "joints": joints, "inverseBindMatrices": 0 }]);
        text["accessors"] = json!([{ "bufferView": 0, "componentType": 5126, "count": joints.len(), "type": "MAT4" }]);
        text["bufferViews"] = json!([{ "buffer": 0, "byteLength": bytes.len() }]);
        text["buffers"] = json!([{ "byteLength": bytes.len() }]);
    }
    text
}
