//! Import cycles between the files of a crate: strongly connected components of their graph.

use std::collections::{BTreeMap, BTreeSet};

use super::rules::Violation;
use super::sources::{Sources, Target};

const RULE: &str = "no two files need each other";

/// Edge of the file graph, and the first line that makes it.
type Edges = BTreeMap<usize, BTreeMap<usize, (usize, String)>>;

/// One violation for each file of a strongly connected component, with the lines that tie it to the others.
pub(super) fn violations(sources: &Sources) -> Vec<Violation> {
    let edges = edges(sources);
    let mut found = Vec::new();
    for component in components(sources.files.len(), &edges) {
        for file in &component {
            let from = &sources.files[*file];
            let inside = edges.get(file).into_iter().flatten();
            let lines: Vec<String> = inside
                .filter(|(to, _)| component.contains(to))
                .map(|(to, (line, name))| {
                    format!("{from}:{line} names `{name}` of {}", sources.files[*to])
                })
                .collect();
            found.extend((!lines.is_empty()).then(|| Violation {
                rule: RULE,
                what: from.clone(),
                lines,
            }));
        }
    }
    found
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
