//! What varies in a sweep: numbers and words of a scene, all combinations of them, a sample, or the designs of a table.

use std::path::Path;

use dashpot_analysis::sweep::Grid;
use dashpot_scene::{DataTable, LeftOut, Listed, ListedFault, TunableFault, Tunables, Variation};

use super::SweepArguments;
use crate::{
    counts::SWEEP_POINTS,
    error::{CliError, StudyError},
    input::bare_numbers,
    terminal::note,
};

pub(super) struct Varied {
    pub(super) tunables: Tunables,
    pub(super) variations: Vec<Variation>,
    /// The number or word of the scene that each variation is of; `None` of what but names the designs of a table.
    pub(super) matched: Vec<Option<usize>>,
    /// The line of each design in its table; empty where there is none.
    pub(super) lines: Vec<usize>,
    /// What the command line gives of each, where a sample was taken of it: `5..30 MN/m`.
    pub(super) ranges: Vec<String>,
    pub(super) form: Form,
}

/// Which values go together.
pub(super) enum Form {
    /// All combinations.
    Combined,
    /// All combinations of these; with words among them no number says how near points are to each other.
    Mixed(Grid),
    /// Those of one row of a table.
    Listed,
    /// Those of one design of a sample.
    Sampled,
}

/// The designs in a file; lines of it that are left out are told.
fn listed(file: &Path) -> Result<Listed, CliError> {
    let input = crate::input::read_input(file)?;
    let text = input.table_text();
    let fault = |fault| CliError::Listed { file: file.to_owned(), fault: Box::new(fault) };
    let designs = Variation::listed(&text).map_err(fault)?;
    if let Some(lines) = DataTable::read(&text).ok().as_ref().and_then(LeftOut::of) {
        note(&format!("file `{}`: {lines}", file.display()));
    }
    Ok(designs)
}

impl Varied {
    /// What the command line names of the scene with this text.
    pub(super) fn of(arguments: &SweepArguments, text: &str, file: &str) -> Result<Self, CliError> {
        let tunables = Tunables::of(text, Some(file)).map_err(StudyError::Scene)?;
        if let Some(file) = &arguments.points {
            return Self::of_designs(tunables, file);
        }
        let all = arguments.vary.iter().map(|own| Variation::parse(own));
        let mut variations: Vec<Variation> = all.collect::<Result<_, _>>()?;
        let flag = "--vary";
        let matched = tunables.matched(&mut variations, bare_numbers());
        let matched = matched.map_err(|fault| CliError::Tunable { flag, fault })?;
        let mut form = Form::Combined;
        if let Some(count) = arguments.sample {
            variations = Variation::sampled(&variations, count, arguments.seed);
            // They are numbers of the scene once more.
            let matched = tunables.matched(&mut variations, bare_numbers());
            matched.map_err(|fault| CliError::Tunable { flag, fault })?;
            form = Form::Sampled;
        } else if variations.iter().any(Variation::is_of_words) && variations.len() > 1 {
            form = Grid::new(counts(&variations)).map_or(form, Form::Mixed);
        }
        let range = |own: &String| own.split_once('=').map_or("", |own| own.1).trim().to_owned();
        let ranges = arguments.vary.iter().map(range).collect();
        let matched = matched.into_iter().map(Some).collect();
        Ok(Self { tunables, variations, matched, lines: Vec::new(), ranges, form })
    }

    /// The designs of a table. A column of words that is like nothing in the scene names them.
    fn of_designs(tunables: Tunables, file: &Path) -> Result<Self, CliError> {
        let Listed { columns, lines } = listed(file)?;
        let is_name = |own: &Variation| {
            let found = tunables.anything(&own.name);
            own.is_of_words() && matches!(found, Err(TunableFault::Unknown { near: None, .. }))
        };
        let (mut variations, mut others): (Vec<_>, Vec<_>) = columns.into_iter().partition(is_name);
        if others.is_empty() {
            let fault = Box::new(ListedFault::NoHeader);
            return Err(CliError::Listed { file: file.to_owned(), fault });
        }
        for own in &variations {
            note(&format!("column `{}` is nothing in the scene: it names the designs", own.name));
        }
        let matched = tunables.matched(&mut others, bare_numbers());
        let flag = "--points";
        let matched = matched.map_err(|fault| CliError::Tunable { flag, fault })?;
        let of_names = variations.iter().map(|_| None);
        let matched = of_names.chain(matched.into_iter().map(Some)).collect();
        variations.append(&mut others);
        Ok(Self { tunables, variations, matched, lines, ranges: Vec::new(), form: Form::Listed })
    }

    /// Whether the values of a row go together, in place of all combinations.
    pub(super) fn is_of_rows(&self) -> bool {
        matches!(self.form, Form::Listed | Form::Sampled)
    }

    /// Whether nothing says how near its points are to each other.
    pub(super) fn is_apart(&self) -> bool {
        self.is_of_rows() || self.variations.iter().any(Variation::is_of_words)
    }

    /// All points; `None` where there are too many.
    pub(super) fn grid(&self) -> Option<Grid> {
        let grid = match &self.form {
            Form::Combined if self.variations.is_empty() => Grid::new(vec![1]),
            Form::Combined => Grid::new(counts(&self.variations)),
            Form::Mixed(all) => Grid::new(vec![all.len()]),
            Form::Listed | Form::Sampled => Grid::new(vec![self.variations[0].len()]),
        };
        grid.filter(|grid| grid.len() <= SWEEP_POINTS.most())
    }

    /// Which of its values each parameter takes at a point of the grid.
    pub(super) fn places(&self, of_grid: &[usize]) -> Vec<usize> {
        match &self.form {
            Form::Combined => of_grid.to_vec(),
            Form::Mixed(all) => all.places(of_grid[0]),
            Form::Listed | Form::Sampled => vec![of_grid[0]; self.variations.len()],
        }
    }

    /// The points at which something wrong with the values shows, rising: the corners of the grid, and every word.
    pub(super) fn telling(&self, grid: &Grid) -> Vec<usize> {
        let mut points: Vec<usize> = grid.corners().into_iter().take(MOST_CORNERS).collect();
        let of_scene = |own: &(usize, &Variation)| self.matched[own.0].is_some();
        let all = self.variations.iter().enumerate().filter(of_scene);
        for (axis, own) in all.filter(|own| own.1.is_of_words()) {
            let mut known: Vec<&str> = Vec::new();
            for (place, word) in own.words.iter().enumerate() {
                if known.contains(&word.as_str()) || known.len() >= MOST_CORNERS {
                    continue;
                }
                known.push(word);
                points.push(match &self.form {
                    Form::Mixed(all) => all.on_axis(axis, place),
                    _ => place,
                });
            }
        }
        points.sort_unstable();
        points.dedup();
        points
    }

    /// What stands in the scene at a point of the grid.
    pub(super) fn written_at(&self, of_grid: &[usize]) -> Vec<(usize, String)> {
        let all = self.matched.iter().zip(&self.variations).zip(self.places(of_grid));
        all.filter_map(|((at, own), place)| Some(((*at)?, own.text(place)))).collect()
    }

    /// Its text there.
    pub(super) fn text_at(&self, of_grid: &[usize]) -> String {
        self.tunables.text_with(&self.written_at(of_grid))
    }

    /// Whether what is set by this name is among what varies.
    pub(super) fn has(&self, name: &str) -> bool {
        self.tunables.anything(name).is_ok_and(|at| self.matched.contains(&Some(at)))
    }
}

fn counts(variations: &[Variation]) -> Vec<usize> {
    variations.iter().map(Variation::len).collect()
}

/// So many corners of the grid are read before anything is solved.
const MOST_CORNERS: usize = 64;
