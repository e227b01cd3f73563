//! The tree of nodes: where each mesh, camera and light of the scene is.

use super::json::At;
use crate::asset::model::MeshError;
use crate::asset::report::{About, ImportReport};
use crate::math::{DAffine3, DVec3};
use glam::{DMat4, DQuat, DVec4};
use rustc_hash::FxHashMap;

/// A node that the scene shows, and its place.
pub(super) struct Placed<'a> {
    pub(super) node: At<'a>,
    pub(super) index: usize,
    pub(super) world_from_node: DAffine3,
}

/// The nodes of the scene that is shown, each before its children, with where they are in the world.
///
/// A node is placed once: a tree that bites its own tail, or shares a branch, loses what closes the circle.
pub(super) fn placed<'a>(root: &At<'a>, report: &mut ImportReport) -> Result<Vec<Placed<'a>>, MeshError> {
    let nodes = root.list("nodes")?;
    let mut seen = vec![false; nodes.len()];
    let mut out = Vec::new();
    let mut open: Vec<(usize, DAffine3)> = roots(root, &nodes, report)?;
    open.reverse();
    while let Some((index, parent)) = open.pop() {
        if std::mem::replace(&mut seen[index], true) {
            report.left_out(About::Shape, format!("`nodes[{index}]` in a second place"));
            continue;
        }
        let node = &nodes[index];
        let world_from_node = match local(node) {
            Ok(local) => parent * local,
            Err(error) => {
                report.left_out(About::Shape, format!("{error}: the node with all below it"));
                continue;
            }
        };
        for child in references(node, "children", nodes.len(), report)?.into_iter().rev() {
            open.push((child, world_from_node));
        }
        out.push(Placed { node: node.clone(), index, world_from_node });
    }
    Ok(out)
}

/// The nodes that the scene begins with: those of the scene that the file shows first, or those without parents.
fn roots(
    root: &At<'_>,
    nodes: &[At<'_>],
    report: &mut ImportReport,
) -> Result<Vec<(usize, DAffine3)>, MeshError> {
    let scenes = root.list("scenes")?;
    // A file without scenes can show none: it shows what it has.
    let wanted = if scenes.is_empty() { None } else { root.refer("scene", root, "scenes")? };
    if scenes.len() > 1 {
        let others = scenes.len() - 1;
        report.passed_over(About::Shape, format!("all scenes but one ({others})"));
    }
    let found = match scenes.get(wanted.unwrap_or(0)) {
        Some(scene) => references(scene, "nodes", nodes.len(), report)?,
        None => {
            let mut is_child = vec![false; nodes.len()];
            for node in nodes {
                let children = references(node, "children", nodes.len(), report)?;
                children.into_iter().for_each(|child| is_child[child] = true);
            }
            (0..nodes.len()).filter(|&index| !is_child[index]).collect()
        }
    };
    Ok(found.into_iter().map(|index| (index, DAffine3::IDENTITY)).collect())
}

/// The nodes that a list names; those that are not there are left out.
fn references(
    at: &At<'_>,
    list: &str,
    count: usize,
    report: &mut ImportReport,
) -> Result<Vec<usize>, MeshError> {
    let mut out = Vec::new();
    for element in at.list(list)? {
        let index = element.value.as_u64().and_then(|index| usize::try_from(index).ok());
        match index.filter(|index| *index < count) {
            Some(index) => out.push(index),
            None => report.left_out(About::Shape, format!("`{}`, as there are {count} nodes", element.path)),
        }
    }
    Ok(out)
}

/// The transform of a node in that of its parent: a matrix, or translation, rotation and scale.
fn local(node: &At<'_>) -> Result<DAffine3, MeshError> {
    if let Some(matrix) = node.numbers::<16>("matrix")? {
        let matrix = DMat4::from_cols_array(&matrix);
        if (matrix.row(3) - DVec4::W).abs().max_element() > 1e-6 {
            return Err(node.wrong("has a `matrix` whose last row is not 0, 0, 0, 1"));
        }
        return Ok(DAffine3::from_mat4(matrix));
    }
    let translation = node.numbers::<3>("translation")?.map_or(DVec3::ZERO, DVec3::from_array);
    let scale = node.numbers::<3>("scale")?.map_or(DVec3::ONE, DVec3::from_array);
    let rotation = match node.numbers::<4>("rotation")?.map(DQuat::from_array) {
        None => DQuat::IDENTITY,
        Some(turn) if turn.is_finite() && turn.length_squared() > 0.0 => turn.normalize(),
        Some(_) => return Err(node.wrong("has a `rotation` that is no direction")),
    };
    Ok(DAffine3::from_scale_rotation_translation(scale, rotation, translation))
}

/// Where each placed node is, by its index.
pub(super) fn worlds(placed: &[Placed<'_>]) -> FxHashMap<usize, DAffine3> {
    placed.iter().map(|placed| (placed.index, placed.world_from_node)).collect()
}
