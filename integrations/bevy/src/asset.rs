//! [`AimRigAsset`]: a rig loaded as a Bevy asset.

use std::fmt;
use std::sync::Arc;

use aim::Rig;
use aim_character::InterpretedRig;
use bevy_app::{AnimationSystems, App, PostUpdate};
use bevy_asset::io::Reader;
use bevy_asset::{Asset, AssetApp, AssetEvent, AssetId, AssetLoader, AssetServer, Assets, LoadContext};
use bevy_ecs::entity::Entity;
use bevy_ecs::message::MessageReader;
use bevy_ecs::query::Has;
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::{Commands, Query, Res};
use bevy_reflect::TypePath;

use crate::character::Source;
use crate::find::{Found, LoadedRig, find_bones};
use crate::{AimCharacter, SharedRig};

/// A rig loaded from a TOML declaration, `hero.aim.toml`, as `aim rig hero.glb` prints it.
#[derive(Asset, TypePath, Clone)]
pub struct AimRigAsset {
    /// The rig.
    pub rig: SharedRig,
}

impl AimRigAsset {
    /// Parses a TOML declaration; `name` is the file name that error messages show.
    ///
    /// # Errors
    /// The errors of the declaration, rendered with lines and columns.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, AimRigError> {
        let spec =
            aim_codegen::declare::from_toml(name, text).map_err(|errors| AimRigError::Declaration(errors.render()))?;
        Ok(Self { rig: Arc::new(InterpretedRig::new(&spec)) })
    }
}

impl fmt::Debug for AimRigAsset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AimRigAsset").field("rig", &(&self.rig as &dyn Rig)).finish()
    }
}

/// An error from loading a rig.
#[derive(Debug)]
#[non_exhaustive]
pub enum AimRigError {
    /// The file could not be read.
    Io(std::io::Error),
    /// The file is not UTF-8 text.
    Text,
    /// The errors of the declaration, rendered with lines and columns.
    Declaration(String),
}

impl fmt::Display for AimRigError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "the rig could not be read: {error}"),
            Self::Text => f.write_str("a rig is a text in UTF-8"),
            Self::Declaration(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for AimRigError {}

/// Loads an [`AimRigAsset`] from `*.aim.toml`.
#[derive(Clone, Copy, Debug, Default, TypePath)]
pub struct AimRigLoader;

impl AssetLoader for AimRigLoader {
    type Asset = AimRigAsset;
    type Settings = ();
    type Error = AimRigError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        _settings: &(),
        context: &mut LoadContext<'_>,
    ) -> Result<AimRigAsset, AimRigError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await.map_err(AimRigError::Io)?;
        let text = std::str::from_utf8(&bytes).map_err(|_| AimRigError::Text)?;
        AimRigAsset::from_toml(&context.path().to_string(), text)
    }

    fn extensions(&self) -> &[&str] {
        &["aim.toml"]
    }
}

pub(crate) fn build(app: &mut App) {
    // Without an `AssetServer`, characters can still take their rigs from other sources.
    if app.world().contains_resource::<AssetServer>() {
        app.init_asset::<AimRigAsset>().init_asset_loader::<AimRigLoader>();
        app.add_systems(PostUpdate, take_over.before(find_bones).before(AnimationSystems));
    }
}

/// Inserts [`LoadedRig`] for each character whose asset has been loaded, and replaces it if the asset was modified.
fn take_over(
    mut commands: Commands<'_, '_>,
    rigs: Res<'_, Assets<AimRigAsset>>,
    mut events: MessageReader<'_, '_, AssetEvent<AimRigAsset>>,
    characters: Query<'_, '_, (Entity, &AimCharacter, Has<LoadedRig>)>,
) {
    let changed: Vec<AssetId<AimRigAsset>> = events
        .read()
        .filter_map(|event| match event {
            AssetEvent::Modified { id } => Some(*id),
            _ => None,
        })
        .collect();
    for (entity, character, has_rig) in &characters {
        let Source::Asset(handle) = &character.source else { continue };
        if has_rig && !changed.contains(&handle.id()) {
            continue;
        }
        if let Some(AimRigAsset { rig }) = rigs.get(handle) {
            let found = Found { rig: rig.clone(), up: None, trunk: None, bind: Vec::new() };
            commands.entity(entity).try_insert(LoadedRig(found));
        }
    }
}
