//! `--shard`, and `dashpot merge`: a sweep in parts that are solved at other times or by other machines.

use std::{
    fmt, fs,
    path::{Path, PathBuf},
};

use clap::Args;
use dashpot_analysis::sweep::{Column, Shard};
use dashpot_scene::Scene;
use serde::{Deserialize, Serialize};

use super::{OutputArguments, SweepArguments, identity::Identity, solved_or_merged};
use crate::error::shards::ShardFault;
use crate::{
    counts::SHARDS,
    error::{CliError, Status},
    folder::{RESULT, Staged},
    input::title,
    output::{Study, Text, VERSION, list, object},
    terminal::{Terminal, note},
};
use dashpot_report::numbers::counted;
use dashpot_studies::origin;

/// File of a shard with its values and then their errors, of each point one for each measure: in SI units, as
/// doubles of 8 bytes, the lowest first.
pub(super) const VALUES: &str = "values.f64";

/// `merge`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    for i in 1 2 3 4; do\n    \
    dashpot sweep pad.toml --vary \"K=5..30 MN/m,1000\" --shard $i/4 --out part-$i\n  \
    done\n  \
    dashpot merge part-* --out result\n\n\
    The scene is read again, so it has to be where it was. Nothing is solved but what \
    tells that the shards belong together.")]
pub(crate) struct MergeArguments {
    /// Folders of all shards of a sweep, in any order.
    #[arg(value_name = "DIR", required = true, value_hint = clap::ValueHint::DirPath)]
    shards: Vec<PathBuf>,
    /// Exits with 4 unless every point keeps every limit, however the errors lie.
    #[arg(long)]
    enforce: bool,
    #[command(flatten)]
    output: OutputArguments,
}

/// Before the hash of all that stands before it, the last key of a shard's result: nothing of it is believed before.
const DIGEST: &str = ",\n  \"digest\": \"";

/// Which shard of how many.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Place {
    /// Its number, from 1.
    pub(super) number: usize,
    pub(super) of: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}/{}", self.number, self.of)
    }
}

/// `3/10`.
pub(super) fn place(text: &str) -> Result<Place, String> {
    let both = text.split_once('/').map(|own| (own.0.trim().parse(), own.1.trim().parse()));
    match both {
        Some((Ok(number), Ok(of))) if (1..=of).contains(&number) && SHARDS.allows(of) => {
            Ok(Place { number, of })
        }
        Some((Ok(0), Ok(of))) => Err(format!("shards are counted from 1: 1/{of} is the first")),
        _ => Err("write the number of the shard and how many there are, such as 3/10".to_owned()),
    }
}

/// The hash of all on which the values of a sweep depend.
pub(super) fn fingerprint(arguments: &SweepArguments, scene: &Scene, columns: &[Column]) -> String {
    // Another name of the same file makes no difference.
    let mut asked = arguments.clone();
    let points =
        asked.points.take().map(|own| origin::of_file(&own.to_string_lossy(), &crate::input::load));
    asked.scene.scene = None;
    let files =
        list(origin::of_files(scene, &crate::input::load).into_iter().map(|own| own.sha256));
    let columns = list(columns.iter().map(|own| (&own.key, own.is_share)));
    let all = (VERSION, origin::of_text(scene), files, asked, points, columns);
    origin::sha256(serde_json::to_string(&all).unwrap_or_default().as_bytes())
}

/// A shard that was solved, as it is written.
pub(super) struct OfShard<'s> {
    arguments: &'s SweepArguments,
    scene: &'s Scene,
    place: Place,
    sweep: String,
    identity: Identity,
    points: usize,
    shard: Shard,
    bytes: Vec<u8>,
}

impl<'s> OfShard<'s> {
    /// The shard at a place of a `sweep` of so many points.
    pub(super) fn of(
        (arguments, place): (&'s SweepArguments, Place),
        (scene, sweep, identity): (&'s Scene, String, Identity),
        points: usize,
        shard: Shard,
    ) -> Self {
        let both = shard.values.iter().chain(&shard.errors);
        let bytes = both.flat_map(|own| own.to_le_bytes()).collect();
        Self { arguments, scene, place, sweep, identity, points, shard, bytes }
    }

    /// Failed where no point of it could be solved.
    pub(super) fn status(&self) -> Status {
        let failed = self.shard.gaps.iter().filter(|gap| gap.column.is_none()).count();
        if failed > 0 && failed == self.shard.points.len() {
            Status::RunFailed
        } else {
            Status::Done
        }
    }
}

impl Study for OfShard<'_> {
    fn text(&self, text: &mut Text) {
        let Place { number, of } = self.place;
        let all = self.points;
        text.title(title(self.scene));
        let points = &self.shard.points;
        let which = match points.len() {
            0 => format!(
                "shard {number} of {of} is empty: there are fewer groups of points than shards"
            ),
            1 => format!("shard {number} of {of}: point {} of {all}", points.end),
            _ => format!(
                "shard {number} of {of}: points {} to {} of {all}",
                points.start + 1,
                points.end
            ),
        };
        let mut items = vec![which];
        let failed = self.shard.gaps.len();
        if failed > 0 {
            items.push(format!("{} missing", counted(failed, "value or point")));
        }
        let warned = self.shard.raised.len();
        if warned > 0 {
            items.push(format!("{}, which `dashpot merge` tells", counted(warned, "warning")));
        }
        items.push("`dashpot merge` puts the folders of all shards together".to_owned());
        text.items(items);
    }

    fn object(&self) -> impl Serialize {
        let content = object! {
            dashpot: VERSION,
            title: &self.scene.title,
            file: &self.scene.file,
            sweep: &self.sweep,
            identity: &self.identity,
            arguments: self.arguments,
            place: self.place,
            shard: &self.shard,
            values: VALUES,
            sha256: origin::sha256(&self.bytes),
        };
        let text = serde_json::to_string_pretty(&content).unwrap_or_default();
        let digest = origin::sha256(text.strip_suffix("\n}").unwrap_or(&text).as_bytes());
        object! { #[serde(flatten)] content, digest }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files.add(VALUES, &self.bytes)
    }
}

/// A shard that was read.
#[derive(Debug, Deserialize)]
pub(super) struct Stored {
    /// The hash of what it is a part of.
    pub(super) sweep: String,
    identity: Identity,
    arguments: SweepArguments,
    place: Place,
    pub(super) shard: Shard,
    sha256: String,
    #[serde(skip)]
    folder: PathBuf,
}

impl Stored {
    /// The shard in a folder, with its values.
    fn read(folder: &Path) -> Result<Self, CliError> {
        let fault = |fault| CliError::Shard { path: folder.to_owned(), fault };
        let text = fs::read(folder.join(RESULT)).map_err(|_| fault(ShardFault::None))?;
        let text = String::from_utf8(text).map_err(|_| fault(ShardFault::Broken(RESULT)))?;
        let Some((content, digest)) = text.rsplit_once(DIGEST) else {
            let is_one = text.contains("\"shard\"");
            return Err(fault(if is_one { ShardFault::Broken(RESULT) } else { ShardFault::None }));
        };
        if digest != origin::sha256(content.as_bytes()) + "\"\n}\n" {
            return Err(fault(ShardFault::Broken(RESULT)));
        }
        let mut own: Self = serde_json::from_str(&text).map_err(|_| fault(ShardFault::None))?;
        if !SHARDS.allows(own.place.of) || !(1..=own.place.of).contains(&own.place.number) {
            return Err(fault(ShardFault::Broken(RESULT)));
        }
        folder.clone_into(&mut own.folder);
        let bytes = fs::read(folder.join(VALUES)).map_err(|_| fault(ShardFault::Broken(VALUES)))?;
        if origin::sha256(&bytes) != own.sha256 {
            return Err(fault(ShardFault::Broken(VALUES)));
        }
        let numbers =
            bytes.chunks_exact(8).filter_map(|own| Some(f64::from_le_bytes(own.try_into().ok()?)));
        own.shard.values = numbers.collect();
        own.shard.errors = own.shard.values.split_off(own.shard.values.len() / 2);
        Ok(own)
    }

    /// Whether the folder of the output has this shard of the sweep, whole. A folder with another one is refused.
    pub(super) fn found(
        output: &OutputArguments,
        place: Place,
        (sweep, identity): (&str, &Identity),
    ) -> Result<bool, CliError> {
        let Some(folder) = &output.out else { return Ok(false) };
        match Self::read(folder) {
            Ok(own) if own.sweep == sweep && own.place == place => {
                let Place { number, of } = place;
                note(&format!(
                    "`{}` has shard {number} of {of} already, whole: nothing is solved",
                    folder.display()
                ));
                Ok(true)
            }
            Ok(own) => Err(own.fault(ShardFault::Taken(identity.differences(&own.identity)))),
            Err(_) => Ok(false),
        }
    }

    /// What is wrong with its folder.
    pub(super) fn fault(&self, fault: ShardFault) -> CliError {
        CliError::Shard { path: self.folder.clone(), fault }
    }
}

/// Puts the shards of a sweep together.
pub(crate) fn merged(arguments: &MergeArguments, terminal: Terminal) -> Result<Status, CliError> {
    let all = arguments.shards.iter().map(|own| Stored::read(own));
    let mut all: Vec<Stored> = all.collect::<Result<_, _>>()?;
    let Some(first) = all.first() else { return Ok(Status::Done) };
    let (sweep, of, asked) = (first.sweep.clone(), first.place.of, first.arguments.clone());
    if let Some(own) = all.iter().find(|own| own.sweep != sweep || own.place.of != of) {
        return Err(own.fault(ShardFault::OfAnother));
    }
    all.sort_by_key(|own| own.place.number);
    if let Some(pair) = all.windows(2).find(|pair| pair[0].place == pair[1].place) {
        return Err(pair[1].fault(ShardFault::Twice));
    }
    let is_missing = |number: &usize| all.iter().all(|own| own.place.number != *number);
    let numbers: Vec<usize> = (1..=of).filter(is_missing).collect();
    if !numbers.is_empty() {
        return Err(CliError::ShardsMissing { numbers, of });
    }
    let asked =
        SweepArguments { enforce: arguments.enforce, output: arguments.output.clone(), ..asked };
    solved_or_merged(&asked, Some(all), terminal)
}
