//! Import cycles between the files of a crate: strongly connected components of their graph.

use std::collections::{BTreeMap, BTreeSet};

use super::rules::Violation;
use super::sources::{Sources, Target};

const RULE: &str = "no two files need each other";

/// Edge of the file graph, and the first line that makes it.
type Edges = BTreeMap<usize, BTreeMap<usize, (usize, String)>>;

/// One violation for each strongly connected component of more than one file.
pub(super) fn violations(sources: &Sources) -> Vec<Violation> {
    let edges = edges(sources);
    components(sources.files.len(), &edges)
        .into_iter()
        .filter(|component| component.len() > 1)
        .map(|component| {
            let names: BTreeSet<&str> = component.iter().map(|f| sources.files[*f].as_str()).collect();
            let mut lines = Vec::new();
            for file in &component {
                for (to, (line, name)) in edges.get(file).into_iter().flatten() {
                    if component.contains(to) {
                        let (from, to) = (&sources.files[*file], &sources.files[*to]);
                        lines.push(format!("{from}:{line} names `{name}` of {to}"));
                    }
                }
            }
            Violation {
                rule: RULE,
                what: Vec::from_iter(names).join(", "),
                lines,
            }
        })
        .collect()
}

fn edges(sources: &Sources) -> Edges {
    let mut edges = Edges::new();
    for reference in &sources.references {
        if let Target::Item(file, name) = &reference.target
            && *file != reference.file
        {
            let from = edges.entry(reference.file).or_default();
            from.entry(*file)
                .or_insert_with(|| (reference.line, name.clone()));
        }
    }
    edges
}

/// Files that reach each other, by reachability: the graphs have some hundred nodes.
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
