//! The `dashpot` command; everything it does is in `dashpot-cli`.
fn main() -> std::process::ExitCode {
    dashpot_cli::main()
}
