//! Compares the tables of options in the book with the command line.

use clap::{CommandFactory, Parser, ValueEnum};

use crate::cli::Arguments;
use crate::cli::arguments::ChildArguments;
use crate::solve::protocol::COMMAND;

/// Option, variable and default of each option of a command, which may be one of another.
fn options(names: &[&str]) -> Vec<[String; 3]> {
    let main = Arguments::command();
    let command = names.iter().fold(&main, |command, name| {
        command.find_subcommand(name).expect("a command")
    });
    let mut options: Vec<[String; 3]> = command
        .get_arguments()
        .filter(|argument| argument.get_id() != "help")
        .map(|argument| {
            let long = argument.get_long().expect("only long options");
            let variable = argument.get_env();
            let default = argument.get_default_values().first();
            [
                format!("`--{long}`"),
                variable.map_or_else(
                    || "-".to_owned(),
                    |variable| format!("`{}`", variable.to_string_lossy()),
                ),
                default.map_or_else(
                    || "-".to_owned(),
                    |value| format!("`{}`", value.to_string_lossy()),
                ),
            ]
        })
        .collect();
    options.sort();
    options
}

#[test]
fn the_book_lists_every_option_with_its_variable_and_default() {
    let [options_page, workers, slurm] = [
        include_str!("../../../docs/operation/options.md"),
        include_str!("../../../docs/operation/workers.md"),
        include_str!("../../../docs/operation/slurm.md"),
    ];
    for (page, header, command) in [
        (options_page, "| option |", &["serve"][..]),
        (workers, "| option of `work` |", &["work"]),
        (slurm, "| option of `pilot slurm` |", &["pilot", "slurm"]),
    ] {
        let table = page.lines().skip_while(|line| !line.starts_with(header));
        let table = table.take_while(|line| line.starts_with('|'));
        let mut rows: Vec<[String; 3]> = table
            .filter(|line| line.starts_with("| `--"))
            .map(|line| {
                let cells: Vec<&str> = line.split('|').map(str::trim).collect();
                [cells[1], cells[2], cells[3]].map(str::to_owned)
            })
            .collect();
        rows.sort();
        assert_eq!(rows, options(command), "{command:?}");
    }
}

#[test]
fn the_command_line_is_consistent() {
    Arguments::command().debug_assert();
    ChildArguments::command().debug_assert();
    assert!(Arguments::try_parse_from(["fretwear", "serve", "--attempts", "0"]).is_err());
    assert!(Arguments::try_parse_from(["fretwear", "serve", "--lease-s", "-1"]).is_err());
}

#[test]
fn the_command_of_solving_processes_is_never_named() {
    let error = Arguments::try_parse_from(["fretwear", "solv"]).expect_err("no command");
    let error = error.to_string();
    assert!(
        error.contains("'solve'") && !error.contains(COMMAND),
        "{error}"
    );
    let mut names = Arguments::command();
    let help = names.render_long_help().to_string();
    assert!(help.contains("solve") && !help.contains(COMMAND), "{help}");
    let shells = clap_complete::Shell::value_variants();
    assert!(!shells.is_empty());
    for shell in shells {
        let mut script = Vec::new();
        clap_complete::generate(*shell, &mut names, "fretwear", &mut script);
        let script = String::from_utf8(script).expect("text");
        assert!(
            script.contains("solve") && !script.contains(COMMAND),
            "{shell}"
        );
    }
}
