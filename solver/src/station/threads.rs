//! Stations in threads: each is solved alone, and results are gathered in the order of the stations, so that they do not depend on the
//! number of threads.

use super::section::Station;
use crate::contact::ContactError;

/// Does the same with all stations.
///
/// # Errors
/// The error of the first station that has one, with its number.
pub(super) fn for_each(
    stations: &mut [Station],
    threads: usize,
    work: impl Fn(&mut Station) -> Result<(), ContactError> + Sync,
) -> Result<(), (usize, ContactError)> {
    let share = stations.len().div_ceil(threads.max(1));
    let in_order = |first: usize, stations: &mut [Station]| {
        for (j, station) in stations.iter_mut().enumerate() {
            work(station).map_err(|error| (first + j, error))?;
        }
        Ok(())
    };
    let mut results = vec![Ok(()); stations.len().div_ceil(share)];
    std::thread::scope(|scope| {
        let mut parts = stations.chunks_mut(share).zip(&mut results).enumerate();
        let own = parts.next();
        for (part, (stations, result)) in parts {
            let in_order = &in_order;
            scope.spawn(move || *result = in_order(part * share, stations));
        }
        if let Some((_, (stations, result))) = own {
            *result = in_order(0, stations);
        }
    });
    results.into_iter().collect()
}
