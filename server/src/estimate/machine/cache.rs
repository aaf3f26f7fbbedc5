//! Calibration cache in memory and in a file: a machine is measured once for each build of the program.

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use api::plan::MachineFigures;
use tokio::sync::Mutex;

use crate::estimate::machine::calibration::{measure, program};
use crate::estimate::machine::coefficients::{MachineError, checked};
use crate::export::files;

/// Wait after a failed measurement before the next one.
const RETRY_AFTER: Duration = Duration::from_mins(1);

/// The calibration of this machine, in memory and in a file.
#[derive(Debug, Clone)]
pub struct CalibrationCache {
    file: Option<PathBuf>,
    cached: Arc<OnceLock<MachineFigures>>,
    /// Locked during a measurement, so that there is only one; holds the time of the last failure.
    measuring: Arc<Mutex<Option<Instant>>>,
    measure: fn() -> Result<MachineFigures, MachineError>,
}

impl CalibrationCache {
    /// Opens the cache; a file of another build of the program is ignored.
    pub fn open(file: Option<PathBuf>) -> Self {
        let cached = OnceLock::new();
        let read = file.as_deref().and_then(read);
        if let Some(figures) = read.filter(|figures| figures.program == program()) {
            // The new cell is empty: this succeeds.
            let _ = cached.set(figures);
        }
        Self {
            file,
            cached: Arc::new(cached),
            measuring: Arc::default(),
            measure,
        }
    }

    /// A cache of given figures, without a file.
    pub fn of(figures: MachineFigures) -> Self {
        Self {
            cached: Arc::new(OnceLock::from(figures)),
            ..Self::open(None)
        }
    }

    /// The figures, if the machine has been measured.
    pub fn get(&self) -> Option<&MachineFigures> {
        self.cached.get()
    }

    /// The figures; measures the machine if necessary, which blocks for a second or two. A failure is logged and
    /// returns nothing.
    pub fn get_or_measure(&self) -> Option<&MachineFigures> {
        if self.cached.get().is_none() {
            match (self.measure)() {
                Ok(figures) => {
                    if let Some(file) = &self.file {
                        write(file, &figures);
                    }
                    // Figures of another thread are equally valid.
                    let _ = self.cached.set(figures);
                }
                Err(error) => tracing::warn!(%error, "calibration of the machine failed"),
            }
        }
        self.cached.get()
    }

    /// The same without blocking other tasks: concurrent callers share one measurement, and a failure is repeated for a
    /// minute.
    pub async fn get_or_measure_async(&self) -> Option<MachineFigures> {
        if let Some(cached) = self.get() {
            return Some(cached.clone());
        }
        // The caller may be cancelled; the lock moves into the measurement.
        let mut failed = Arc::clone(&self.measuring).lock_owned().await;
        let cache = self.clone();
        let measured = tokio::task::spawn_blocking(move || {
            let too_early = failed.is_some_and(|at| at.elapsed() < RETRY_AFTER);
            if too_early && cache.get().is_none() {
                return None;
            }
            let measured = cache.get_or_measure().cloned();
            *failed = measured.is_none().then(Instant::now);
            measured
        });
        measured.await.ok().flatten()
    }
}

/// The file of the command line, in the user's cache folder.
pub fn cache_file() -> Option<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    let folder = set("XDG_CACHE_HOME")
        .map(PathBuf::from)
        .or_else(|| set("HOME").map(|home| PathBuf::from(home).join(".cache")))?;
    Some(folder.join("fretwear").join("machine.json"))
}

fn read(file: &Path) -> Option<MachineFigures> {
    checked(serde_json::from_slice(&std::fs::read(file).ok()?).ok()?).ok()
}

/// Writes the figures; if that fails, the next process measures again.
fn write(file: &Path, figures: &MachineFigures) {
    let (Some(folder), Some(name)) = (file.parent(), file.file_name()) else {
        return;
    };
    let Ok(bytes) = serde_json::to_vec_pretty(figures) else {
        return;
    };
    if let Err(error) = files::write_atomically(folder, &name.to_string_lossy(), &bytes) {
        tracing::debug!(%error, "the calibration was not written to its file");
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use super::*;

    fn figures() -> MachineFigures {
        MachineFigures {
            program: program(),
            increment_s: 2e-4,
            increment_power: 1.7,
            condensation_dof_s: 4e-7,
            condensation_surface_s: 7e-10,
        }
    }

    #[tokio::test]
    async fn cancelled_callers_start_no_second_measurement() {
        static MEASURED: AtomicU32 = AtomicU32::new(0);
        fn slowly() -> Result<MachineFigures, MachineError> {
            MEASURED.fetch_add(1, Ordering::SeqCst);
            std::thread::sleep(Duration::from_millis(100));
            checked(figures())
        }
        let cache = CalibrationCache {
            measure: slowly,
            ..CalibrationCache::open(None)
        };
        for _ in 0..3 {
            // Cancelled at once.
            tokio::select! {
                biased;
                _ = cache.get_or_measure_async() => {}
                () = std::future::ready(()) => {}
            }
        }
        assert_eq!(cache.get_or_measure_async().await, Some(figures()));
        assert_eq!(MEASURED.load(Ordering::SeqCst), 1);
    }

    #[tokio::test]
    async fn a_failed_measurement_is_not_repeated_at_once() {
        static TRIED: AtomicU32 = AtomicU32::new(0);
        fn failing() -> Result<MachineFigures, MachineError> {
            TRIED.fetch_add(1, Ordering::SeqCst);
            Err(MachineError::Example("preset"))
        }
        let cache = CalibrationCache {
            measure: failing,
            ..CalibrationCache::open(None)
        };
        assert_eq!(
            (
                cache.get_or_measure_async().await,
                cache.get_or_measure_async().await
            ),
            (None, None)
        );
        assert_eq!(TRIED.load(Ordering::SeqCst), 1);
    }

    #[test]
    fn impossible_figures_in_the_file_are_ignored() {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let file = folder.path().join("machine.json");
        write(&file, &figures());
        assert_eq!(
            CalibrationCache::open(Some(file.clone())).get(),
            Some(&figures())
        );
        let wrong = MachineFigures {
            increment_s: -1.0,
            ..figures()
        };
        write(&file, &wrong);
        assert_eq!(CalibrationCache::open(Some(file)).get(), None);
    }

    #[test]
    fn a_machine_is_measured_once_for_each_build() {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let file = folder.path().join("cache").join("machine.json");
        let first = CalibrationCache::open(Some(file.clone()));
        assert_eq!(first.get(), None);
        let figures = first.get_or_measure().expect("it can be measured").clone();
        assert!(figures.increment_s > 0.0 && figures.condensation_dof_s >= 0.0);
        assert_eq!(
            CalibrationCache::open(Some(file.clone())).get(),
            Some(&figures)
        );

        let other = MachineFigures {
            program: "another".to_owned(),
            ..figures
        };
        write(&file, &other);
        assert_eq!(CalibrationCache::open(Some(file)).get(), None);
    }
}
