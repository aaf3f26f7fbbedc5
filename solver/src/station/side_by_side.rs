//! Stations side by side: each is solved alone, and errors are those of the first station that has one, so that results do not depend on the
//! number of threads.

use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};

use super::section::Station;

/// Does the same with all stations, of which each has its number, in the threads that the caller is one of.
///
/// # Errors
/// The error of the first station that has one, with its number.
pub(super) fn for_each<E: Send>(
    stations: &mut [Station],
    work: impl Fn(usize, &mut Station) -> Result<(), E> + Sync + Send,
) -> Result<(), (usize, E)> {
    let failed = if rayon::current_thread_index().is_none() {
        // One after the other, without a pool.
        let mut stations = stations.iter_mut().enumerate();
        stations.find_map(|(number, station)| Some((number, work(number, station).err()?)))
    } else {
        let stations = stations.par_iter_mut().with_max_len(1).enumerate();
        stations
            .filter_map(|(number, station)| Some((number, work(number, station).err()?)))
            .reduce_with(|one, other| if one.0 < other.0 { one } else { other })
    };
    failed.map_or(Ok(()), Err)
}
