//! [`Character`]: a model, its measurement, and the rig that aims it.

use std::path::Path;
use std::sync::Arc;

use aim_animation::Clip;
use aim_character::{
    ChainNodes, MANNEQUIN_RIG, Mannequin, Measurement, PAPER_AXES, Palette, Proposal, chain_nodes, propose,
};
use aim_codegen::RigSpec;
use aim_codegen::declare::from_toml;
use aim_gltf::{Document, Skeleton, Surface};
use aim_runtime::glam::{DVec3, Vec3};

use crate::hand::right_hand;
use crate::skinning::Skinning;

/// The data of a character that does not change while it moves.
#[derive(Debug)]
pub(crate) struct Character {
    /// The file's name.
    pub(crate) name: String,
    pub(crate) document: Arc<Document>,
    pub(crate) measurement: Measurement,
    pub(crate) surface: Arc<Surface>,
    pub(crate) skinning: Arc<Skinning>,
    pub(crate) chain: ChainNodes,
    /// The rig as declared or proposed, with the reasons of a proposal.
    pub(crate) declared: Proposal,
    /// The node of the right hand, if one was found.
    pub(crate) hand: Option<usize>,
    /// The point on the floor below the effector in the bind pose, world space.
    pub(crate) floor: Vec3,
    /// `true` for the mannequin with its own rig, for which compiled code exists.
    pub(crate) is_mannequin: bool,
}

impl Character {
    /// Creates the built-in mannequin, with clips of walking, running, jumping, turning and waving.
    ///
    /// # Errors
    /// None in practice: the mannequin is built from constants.
    pub(crate) fn mannequin() -> Result<Self, String> {
        let model = Mannequin::new().with_moves().glb(|_| PAPER_AXES).map_err(|error| error.to_string())?;
        let document = Document::from_bytes(&model).map_err(|error| error.to_string())?;
        let rig = Some(("rigs/mannequin.toml", MANNEQUIN_RIG));
        Ok(Self { is_mannequin: true, ..Self::new("the mannequin", document, rig)? })
    }

    /// Loads a character from a file, with a rig from a TOML file or a proposed one.
    ///
    /// # Errors
    /// If a file cannot be read or the rig does not fit the model; the message names the file.
    pub(crate) fn open(file: &Path, rig: Option<&Path>) -> Result<Self, String> {
        let document = Document::load(file).map_err(|error| error.in_file(file))?;
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let text = rig.map(|rig| read(rig).map(|text| (rig.display().to_string(), text))).transpose()?;
        Self::new(&name, document, text.as_ref().map(|(name, text)| (name.as_str(), text.as_str())))
    }

    /// Loads a character from a file in memory, with a proposed rig.
    ///
    /// # Errors
    /// See [`open`](Self::open).
    pub(crate) fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, String> {
        let document = Document::from_bytes(bytes).map_err(|error| format!("{name}: {error}"))?;
        Self::new(name, document, None)
    }

    /// Returns the same model with another rig; `rig` is the name for error messages, `text` the TOML.
    ///
    /// # Errors
    /// If the text is not a rig, or the rig's bones are not in the model.
    pub(crate) fn with_rig(&self, rig: &str, text: &str) -> Result<Self, String> {
        Self::new(&self.name, Arc::clone(&self.document), Some((rig, text)))
    }

    fn new(name: &str, document: impl Into<Arc<Document>>, rig: Option<(&str, &str)>) -> Result<Self, String> {
        let document = document.into();
        let measurement = Measurement::of(&document);
        let declared = match rig {
            Some((rig, text)) => {
                let spec = from_toml(rig, text).map_err(|errors| errors.render())?;
                Proposal { reasons: vec![String::new(); spec.joints.len()], spec }
            }
            None => propose(&document, &measurement, None).map_err(|error| format!("{name}: {error}"))?,
        };
        let chain = chain_nodes(&declared.spec, document.skeleton()).map_err(|error| format!("{name}: {error}"))?;
        let hand = right_hand(document.skeleton(), &measurement, chain.joints[chain.joints.len() - 1]);
        let surface = Arc::new(document.surface());
        let skinning = Arc::new(Skinning::new(&document, &surface).map_err(|error| format!("{name}: {error}"))?);
        let mut character = Self {
            name: name.into(),
            document,
            measurement,
            surface,
            skinning,
            chain,
            declared,
            hand,
            floor: Vec3::ZERO,
            is_mannequin: false,
        };
        character.floor = character.find_floor();
        Ok(character)
    }

    fn find_floor(&self) -> Vec3 {
        let [up, ..] = self.directions();
        let effector = self.effector();
        let bind = &self.measurement.bind_world;
        let seen = Palette::new(self.skeleton(), bind).positions(&self.surface);
        let heights = seen.iter().map(|at| at.as_vec3().dot(up)).filter(|height| height.is_finite());
        let lowest = heights.fold(effector.dot(up), f32::min);
        effector + up * (lowest - effector.dot(up))
    }

    pub(crate) fn spec(&self) -> &RigSpec {
        &self.declared.spec
    }

    pub(crate) fn skeleton(&self) -> &Skeleton {
        self.document.skeleton()
    }

    pub(crate) fn clips(&self) -> &[Clip] {
        self.document.clips()
    }

    /// Returns the index of the clip with this name.
    ///
    /// # Errors
    /// If no clip has the name.
    pub(crate) fn clip(&self, name: &str) -> Result<usize, String> {
        self.document.clip(name).map_err(|error| format!("{}: {error}", self.name))?;
        Ok(self.clips().iter().position(|clip| clip.name() == name).unwrap_or(0))
    }

    /// Returns the length, in the file's units, that corresponds to 1 m if the character is 1.7 m tall.
    pub(crate) fn metre(&self) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "a size")]
        let metre = self.measurement.metre() as f32;
        metre
    }

    /// Returns the character's up, forward and left directions: unit vectors, world space.
    pub(crate) fn directions(&self) -> [Vec3; 3] {
        let Measurement { up, forward, left, .. } = &self.measurement;
        [up, forward, left].map(|direction| direction.as_vec3().normalize_or_zero())
    }

    /// Returns the position of the effector in the bind pose, world space.
    pub(crate) fn effector(&self) -> Vec3 {
        let origin = DVec3::from_array(self.spec().effector.origin);
        self.measurement.bind_world[self.chain.joints[0]].transform_point3(origin).as_vec3()
    }
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path)
        .map_err(|error| format!("{}: cannot be read as text ({error}); give a rig's TOML file", path.display()))
}
