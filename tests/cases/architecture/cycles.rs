//! Import cycles between the files of a crate, and between the folders: strongly connected components of their graphs.

use std::collections::{BTreeMap, BTreeSet};

use super::sources::{Sources, Target};
use super::violations::Violation;

/// Edge of a graph, and the first line that makes it.
type Edges = BTreeMap<usize, BTreeMap<usize, String>>;

/// One violation for each file of a circle of files, with the lines that tie it to the others.
pub(super) fn between_files(sources: &Sources) -> Vec<Violation> {
    let rule = "no two files need each other";
    circles(rule, &sources.files, &edges(sources, Some))
}

/// The same of folders and files that are side by side. A file and the folder of its name are one.
pub(super) fn between_folders(sources: &Sources) -> Vec<Violation> {
    let mut found = Vec::new();
    let folders: BTreeSet<&str> = sources
        .files
        .iter()
        .flat_map(|file| folders(file))
        .collect();
    for folder in folders {
        let child = |file: &String| {
            let name = file.strip_prefix(folder)?.strip_prefix('/')?;
            let name = name.split_once('/').map_or(name, |(first, _)| first);
            Some(format!("{folder}/{}", name.trim_end_matches(".rs")))
        };
        let names: Vec<String> = sources.files.iter().filter_map(child).collect();
        let names: Vec<String> = BTreeSet::from_iter(names).into_iter().collect();
        let node = |file: usize| {
            let name = child(&sources.files[file])?;
            names.iter().position(|known| *known == name)
        };
        let rule = "no two folders need each other";
        found.extend(circles(rule, &names, &edges(sources, node)));
    }
    found
}

/// The folders of a file, from the outermost one on.
fn folders(file: &str) -> impl Iterator<Item = &str> {
    file.match_indices('/').map(|(end, _)| &file[..end])
}

fn circles(rule: &'static str, names: &[String], edges: &Edges) -> Vec<Violation> {
    let mut found = Vec::new();
    for component in components(names.len(), edges) {
        for node in &component {
            let inside = edges.get(node).into_iter().flatten();
            let inside = inside.filter(|(to, _)| component.contains(to));
            let lines: Vec<String> = inside.map(|(_, line)| line.clone()).collect();
            found.extend((!lines.is_empty()).then(|| Violation {
                rule,
                what: names[*node].clone(),
                lines,
            }));
        }
    }
    found
}

/// Edges between the nodes that files belong to.
fn edges(sources: &Sources, node: impl Fn(usize) -> Option<usize>) -> Edges {
    let mut edges = Edges::new();
    for reference in &sources.references {
        if let Target::Item(file, name) = &reference.target
            && let (Some(from), Some(to)) = (node(reference.file), node(*file))
            && from != to
        {
            let (at, line) = (&sources.files[reference.file], reference.line);
            let of = &sources.files[*file];
            let line = || format!("{at}:{line} names `{name}` of {of}");
            edges
                .entry(from)
                .or_default()
                .entry(to)
                .or_insert_with(line);
        }
    }
    edges
}

/// Strongly connected components, by reachability: the graphs have some hundred nodes.
fn components(count: usize, edges: &Edges) -> Vec<BTreeSet<usize>> {
    let reached: Vec<BTreeSet<usize>> = (0..count).map(|file| reachable(file, edges)).collect();
    let mut components: Vec<BTreeSet<usize>> = Vec::new();
    for file in 0..count {
        if components.iter().any(|component| component.contains(&file)) {
            continue;
        }
        let back = |other: &usize| reached[*other].contains(&file);
        let mut component: BTreeSet<usize> = reached[file].iter().copied().filter(back).collect();
        component.insert(file);
        components.push(component);
    }
    components
}

fn reachable(file: usize, edges: &Edges) -> BTreeSet<usize> {
    let mut reached = BTreeSet::new();
    let mut open = vec![file];
    while let Some(next) = open.pop() {
        for to in edges.get(&next).into_iter().flat_map(BTreeMap::keys) {
            if reached.insert(*to) {
                open.push(*to);
            }
        }
    }
    reached
}
