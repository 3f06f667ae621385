//! Integration tests of the whole chain, as one binary.
#![expect(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "tests say what they expect"
)]

mod allocations;
mod auto;
mod bad_records;
mod calibration;
mod campaign;
mod claims;
mod cli;
mod cli_models;
mod closed_forms;
mod conformance;
mod contact_forces;
mod contact_geometry;
mod conversions;
mod cost;
mod curve_files;
mod cushion;
mod cushion_scatter;
mod design;
mod design_answers;
mod designs;
mod displaced_starts;
mod docs;
mod driven_contacts;
mod driven_records;
mod durations;
mod effects;
mod equivalence;
mod error_bars;
mod every_law;
mod examples;
mod files;
mod fit;
mod fit_cost;
mod fit_folders;
mod fit_minimum;
mod fit_mistakes;
mod fit_mixed;
mod fit_spectra;
mod floors;
mod formulas;
mod gallery;
mod gradients;
mod hard;
mod independent;
mod layers;
mod limits;
mod loading;
mod measured;
mod mme_in_scenes;
mod moduli;
mod mutated_runs;
mod on_demand;
mod order;
mod pads;
#[cfg(feature = "parquet")]
mod parquet;
mod partial;
mod pictures;
mod plain_impacts;
mod power_laws;
mod properties;
mod random_networks;
mod rating;
mod refused;
mod resultants;
mod scatter;
mod scenes;
mod shards;
mod signal;
mod signal_bars;
mod signal_options;
mod signs;
mod similarity;
mod sizes;
mod small_files;
mod start_positions;
mod sweeps;
mod table_ends;
mod terminal;
mod thesis;
mod thesis_command;
mod thesis_numbers;
mod verdicts;
mod vibration;
mod windows;
mod written_elsewhere;
mod written_otherwise;
