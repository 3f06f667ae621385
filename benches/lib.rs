//! Benchmarks alone: see `docs/benchmarks.md`.
