//! Compares the tables of options in the README with the command line.

use clap::{CommandFactory, Parser};

use crate::cli::Arguments;

const README: &str = include_str!("../../README.md");

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
fn the_readme_lists_every_option_with_its_variable_and_default() {
    for (header, command) in [
        ("| option |", &["serve"][..]),
        ("| option of `work` |", &["work"]),
        ("| option of `pilot slurm` |", &["pilot", "slurm"]),
    ] {
        let table = README.lines().skip_while(|line| !line.starts_with(header));
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
    assert!(Arguments::try_parse_from(["fretwear", "serve", "--attempts", "0"]).is_err());
    assert!(Arguments::try_parse_from(["fretwear", "serve", "--lease-s", "-1"]).is_err());
}
