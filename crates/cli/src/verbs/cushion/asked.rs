//! What cushion curves are asked for: heights, thicknesses, stresses and a limit, from the command and the scene.

use dashpot_analysis::{Bound, Limit, measures::PeakAcceleration};
use dashpot_design::{
    cushion::{Asked, NoCushion, Platen, PoseOfThickness, Row},
    optimum::PoseScattered,
};
use dashpot_network::parameters::{Dimension, Kind as _};
use dashpot_scene::{
    Fault, Scene, Tunables, Variation, VariationFault, parse_limits,
    units::{parse_quantity, si_unit},
    with_units,
};

use super::CushionArguments;
use crate::{
    around::{Around, with_scatter},
    counts::{CURVE_POINTS, CURVES},
    error::{CliError, StudyError},
    input::{Input, setting},
    output::list,
    varied::{Varied, messages, point, posed},
    verbs::run::scatter::ScatterArguments,
};

/// What is wanted of a scene.
pub(super) struct Wanted {
    pub(super) platen: Platen,
    pub(super) asked: Asked,
    /// Where the thickness stands in the text; `None` where it stays.
    thickness: Option<usize>,
    tunables: Tunables,
}

impl Wanted {
    pub(super) fn of(
        arguments: &CushionArguments,
        scene: &Scene,
        input: &Input,
    ) -> Result<Self, CliError> {
        let CushionArguments { platen, pad, .. } = arguments;
        let platen = Platen::of(&scene.network, platen.as_deref(), pad.as_deref())?;
        let tunables = Tunables::of(&scene.text, Some(&input.file)).map_err(StudyError::Scene)?;
        let heights = lengths("--heights", arguments.heights.as_deref())?;
        let no_height = || NoCushion::NoHeight { body: platen.body.clone() };
        let heights = match heights {
            Some(own) => own,
            None => vec![platen.height.ok_or_else(no_height)?],
        };
        let given = lengths("--thickness", arguments.thickness.as_deref())?;
        let thickness = match given {
            Some(_) => Some(tunable(&tunables, &platen.pad)?),
            None => None,
        };
        let thicknesses = given.unwrap_or_else(|| vec![platen.thickness]);
        let pressures = |flag, text: Option<&str>| values(flag, text, Dimension::PRESSURE);
        let stresses = pressures("--stress", arguments.stress.as_deref())?.unwrap_or_default();
        let over = pressures("--over", arguments.over.as_deref())?;
        let over = over.map(|own| [own[0], own[own.len() - 1]]);
        let limit = limit(arguments, scene, &platen)?;
        CURVES.check(heights.len().saturating_mul(thicknesses.len()), "curves")?;
        CURVE_POINTS.check(stresses.len(), "points of a curve")?;
        if over.is_some() && limit.is_none() {
            let reason =
                "it is over this range that a limit has to be kept: give one, `--limit \"50 g\"`";
            return Err(CliError::setting("--over", reason));
        }
        let time = |flag: &str, text: &str| -> Result<f64, CliError> {
            let own = setting(flag, text.trim(), Dimension::TIME)?;
            let wrong = || CliError::setting(flag, format!("`{text}` is not above zero"));
            (own > 0.0).then_some(own).ok_or_else(wrong)
        };
        let between = time("--between", &arguments.between)?;
        let row = arguments.drops.map(|own| Row { drops: usize::from(own), between });
        let creep = arguments.creep.iter().map(|own| time("--creep", own));
        let mut creep = creep.collect::<Result<Vec<_>, _>>()?;
        creep.sort_by(f64::total_cmp);
        let asked = Asked { heights, thicknesses, stresses, limit, over, row, creep, threads: 1 };
        Ok(Self { platen, asked, thickness, tunables })
    }

    /// What poses the scene with the cushion at a thickness.
    pub(super) fn pose<'s>(
        &'s self,
        input: &'s Input,
        set: &'s [(String, String)],
        method: Option<&'s str>,
    ) -> Box<PoseOfThickness<'s>> {
        Box::new(move |thickness: f64| {
            let value = format!("{thickness:e} {}", si_unit(Dimension::LENGTH));
            let values = list(self.thickness.map(|at| (at, value)));
            point(posed((&self.tunables, &values), input, set)?, method)
        })
    }

    /// A sample of scattered designs with the cushion at a thickness; none where no number has scatter that does anything.
    pub(super) fn drawn(
        &self,
        thickness: f64,
        (scene, input): (&Scene, &Input),
        arguments: &CushionArguments,
    ) -> Result<Option<Around>, CliError> {
        let written = self.thickness.map(|at| {
            let own = Varied::of(
                &self.tunables,
                ("thickness", at),
                [thickness; 2],
                ("m", Some(Dimension::LENGTH)),
            );
            let scattered = with_scatter((scene, &self.tunables), (&own, at), thickness);
            (at, scattered.unwrap_or_else(|| own.exact(thickness)))
        });
        let text = self.tunables.text_with(&list(written));
        let sample = ScatterArguments::new(arguments.scatter, arguments.seed);
        Around::of(&text, (input, &arguments.scene.values.set), sample, None)
    }

    /// What poses them.
    pub(super) fn scattered<'s>(
        &'s self,
        of: (&'s Scene, &'s Input),
        arguments: &'s CushionArguments,
        pose: &'s PoseOfThickness<'s>,
    ) -> Box<PoseScattered<'s>> {
        Box::new(move |_, values: &[f64]| {
            let thickness = values.first().copied().unwrap_or(f64::NAN);
            let own = pose(thickness)?;
            let drawn = self.drawn(thickness, of, arguments).map_err(|fault| match fault {
                CliError::Study(StudyError::Scene(faults)) => messages(&faults),
                other => other.to_string(),
            })?;
            drawn.map_or_else(|| Ok(vec![own.clone()]), |drawn| drawn.designs(&own.settings))
        })
    }
}

/// Where the thickness of the cushion stands in the text.
fn tunable(tunables: &Tunables, pad: &str) -> Result<usize, CliError> {
    let name = format!("elements.{pad}.thickness");
    let reason = || {
        format!(
            "the scene has no number for the thickness of `{pad}` that could be varied: write it at the element, \
             `thickness = \"5 cm\"`, or as the name of one of [values]"
        )
    };
    tunables.find(&name).map_err(|_| CliError::setting("--thickness", reason()))
}

/// The most that the peak may be: that of the command, alone or as a limit of runs is written, or the least one of the
/// scene.
fn limit(
    arguments: &CushionArguments,
    scene: &Scene,
    platen: &Platen,
) -> Result<Option<f64>, CliError> {
    let key = format!("{}.{}", platen.body, PeakAcceleration::KIND);
    if let Some(text) = &arguments.limit {
        let wrong = |reason: String| CliError::setting("--limit", reason);
        let low = || wrong(format!("`{text}` is not above zero"));
        if text.contains(['<', '>', '=']) {
            let all = parse_limits(text).map_err(wrong)?;
            let most = most(&all, &key).filter(|_| all.iter().all(|own| own.key == key));
            let unlike =
                || wrong(format!("cushion curves have a most of `{key}`: write \"{key}<=50 g\""));
            let own = most.ok_or_else(unlike)?;
            return if own > 0.0 { Ok(Some(own)) } else { Err(low()) };
        }
        let own = setting("--limit", text, Dimension::ACCELERATION)?;
        return if own > 0.0 { Ok(Some(own)) } else { Err(low()) };
    }
    Ok(most(&scene.limits, &key))
}

/// The least that a measure may be at most.
fn most(limits: &[Limit], key: &str) -> Option<f64> {
    let own = limits.iter().filter(|own| own.key == key);
    let own = own.filter_map(|own| match own.bound {
        Bound::Max(most) => Some(most),
        Bound::Min(_) => None,
    });
    own.reduce(f64::min)
}

fn lengths(flag: &str, text: Option<&str>) -> Result<Option<Vec<f64>>, CliError> {
    values(flag, text, Dimension::LENGTH)
}

/// The values of a range or a list, in SI units, rising and positive.
fn values(
    flag: &str,
    text: Option<&str>,
    dimension: Dimension,
) -> Result<Option<Vec<f64>>, CliError> {
    let Some(text) = text else { return Ok(None) };
    let wrong = |reason: String| CliError::setting(flag, reason);
    let unlike = |fault: Fault| StudyError::quantity(flag, fault);
    let unreadable = |error| unlike(Fault::Unreadable { error, expected: dimension });
    let own = Variation::parse(&format!("values={text}")).map_err(|fault| match fault {
        VariationFault::BadValue { error } => unreadable(error).into(),
        other => wrong(other.to_string()),
    })?;
    if let Some(word) = own.words.first() {
        parse_quantity(word).map_err(unreadable)?;
    }
    match own.dimension {
        Some(found) if found != dimension => {
            let text = text.to_owned();
            return Err(unlike(Fault::WrongDimension { text, found, expected: dimension }).into());
        }
        None => {
            let written = with_units(text, dimension);
            return Err(wrong(format!("`{text}` has no unit: write {written}")));
        }
        Some(_) => {}
    }
    if own.values.iter().any(|own| !(own.is_normal() && *own > 0.0)) {
        return Err(wrong(format!("`{text}` is not above zero throughout")));
    }
    Ok(Some(own.values))
}
