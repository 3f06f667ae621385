//! What a sweep reports of each point, by the keys of measures.

use dashpot_network::parameters::Kind as _;

use super::{Column, ScenePoint, SweepError};
use crate::{
    MeasureWish, RunError,
    measures::{
        Family, PeakDeformation,
        asked::ask,
        selection::{Selected, select},
    },
};

/// The columns of these measures in a scene, and what the scene is to be asked for: all that it reports
/// where none is named. Behind them stands, for each element with a thickness that they are about, or
/// that is at a node that they are about, its peak deformation as a share of that.
///
/// # Errors
///
/// A measure that the scene does not have, and faults of the scene.
pub fn columns(
    scene: &ScenePoint,
    keys: &[String],
) -> Result<(Vec<Column>, Vec<MeasureWish>), SweepError> {
    let assembly = scene.network.compile(scene.settings.duration).map_err(RunError::from)?;
    let mut settings = scene.settings.clone();
    ask(&assembly, &mut settings, keys)?;
    let selected = select(&assembly, &settings.measures, &settings.limits)?;
    let is_limited = |key: &String| settings.limits.iter().any(|own| own.key == *key);
    let is_wanted =
        |own: &&Selected| keys.is_empty() || keys.contains(&own.key) || is_limited(&own.key);
    let mut columns: Vec<Column> = selected
        .iter()
        .filter(is_wanted)
        .map(|own| Column { key: own.key.clone(), unit: own.measure.unit(), is_share: false })
        .collect();
    if columns.is_empty() {
        return Err(SweepError::NoneReported);
    }
    let mut wishes = settings.measures.clone();
    let is_about = |at: usize| {
        let between = assembly.connections[at].between;
        selected.iter().filter(is_wanted).any(|own| match own.measure.applies_to() {
            Family::Element => own.target == at,
            Family::Node => between.iter().any(|end| end.index() == own.target),
        })
    };
    let elements = (0..assembly.connections.len()).filter(|at| is_about(*at));
    for connection in elements.map(|at| &assembly.connections[at]) {
        let key = format!("{}.{}", connection.name, PeakDeformation::KIND);
        let is_known = columns.iter().any(|column| column.is_share && column.key == key);
        if connection.thickness.is_none() || is_known {
            continue;
        }
        if !selected.iter().any(|own| own.key == key) {
            let wish = MeasureWish::new(connection.name.clone(), PeakDeformation::default());
            wishes.push(wish);
        }
        columns.push(Column { key, unit: "1", is_share: true });
    }
    Ok((columns, wishes))
}
