//! The figures in a file, so that a machine is measured once for each program.

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use api::plan::MachineFigures;
use tokio::sync::Mutex;

use crate::estimate::machine::MachineError;
use crate::export::files;

/// How long a machine that could not be measured is left alone.
const PAUSE: Duration = Duration::from_mins(1);

/// The figures of a machine, in memory and in a file.
#[derive(Debug, Clone)]
pub struct CalibrationCache {
    file: Option<PathBuf>,
    known: Arc<OnceLock<MachineFigures>>,
    /// Held while the machine is measured, so that it is measured once; and when that last failed.
    measuring: Arc<Mutex<Option<Instant>>>,
    measure: fn() -> Result<MachineFigures, MachineError>,
}

impl CalibrationCache {
    /// With what the file holds, if that belongs to this program.
    pub fn open(file: Option<PathBuf>) -> Self {
        let known = OnceLock::new();
        let read = file.as_deref().and_then(read);
        if let Some(figures) = read.filter(|figures| figures.program == program()) {
            // A new cell is empty.
            let _ = known.set(figures);
        }
        Self {
            file,
            known: Arc::new(known),
            measuring: Arc::default(),
            measure: crate::estimate::machine::measure,
        }
    }

    /// With figures that are known, and no file.
    pub fn of(figures: MachineFigures) -> Self {
        Self {
            file: None,
            known: Arc::new(OnceLock::from(figures)),
            measuring: Arc::default(),
            measure: crate::estimate::machine::measure,
        }
    }

    /// The figures, if the machine has been measured.
    pub fn known(&self) -> Option<&MachineFigures> {
        self.known.get()
    }

    /// The figures, measured now if they are not known, which takes a second or two of this thread; nothing if that
    /// fails, which is logged.
    pub fn measured(&self) -> Option<&MachineFigures> {
        if self.known.get().is_none() {
            match (self.measure)() {
                Ok(figures) => {
                    if let Some(file) = &self.file {
                        write(file, &figures);
                    }
                    // Another thread's figures are as good.
                    let _ = self.known.set(figures);
                }
                Err(error) => tracing::warn!(%error, "the machine was not measured"),
            }
        }
        self.known.get()
    }

    /// The same beside other tasks: whoever asks meanwhile waits, and a failure holds for a minute.
    pub async fn wait(&self) -> Option<MachineFigures> {
        if let Some(known) = self.known() {
            return Some(known.clone());
        }
        // Whoever asked may leave; the lock stays with the measurement.
        let mut failed = Arc::clone(&self.measuring).lock_owned().await;
        let kept = self.clone();
        let measured = tokio::task::spawn_blocking(move || {
            let lately = failed.is_some_and(|at| at.elapsed() < PAUSE);
            if lately && kept.known().is_none() {
                return None;
            }
            let measured = kept.measured().cloned();
            *failed = measured.is_none().then(Instant::now);
            measured
        });
        measured.await.ok().flatten()
    }
}

/// Where the command line keeps them: in the user's folder for what can be made again.
pub fn cache_file() -> Option<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    let folder = set("XDG_CACHE_HOME")
        .map(PathBuf::from)
        .or_else(|| set("HOME").map(|home| PathBuf::from(home).join(".cache")))?;
    Some(folder.join("fretwear").join("machine.json"))
}

/// This program: its version and when it was built.
pub(crate) fn program() -> String {
    let built = || {
        let program = std::env::current_exe().ok()?;
        let modified = program.metadata().ok()?.modified().ok()?;
        let since = modified.duration_since(std::time::UNIX_EPOCH).ok()?;
        Some(since.as_secs())
    };
    format!(
        "{} {}",
        env!("CARGO_PKG_VERSION"),
        built().unwrap_or_default()
    )
}

fn read(file: &Path) -> Option<MachineFigures> {
    crate::estimate::machine::checked(serde_json::from_slice(&std::fs::read(file).ok()?).ok()?).ok()
}

/// Figures that cannot be kept are measured again next time.
fn write(file: &Path, figures: &MachineFigures) {
    let (Some(folder), Some(name)) = (file.parent(), file.file_name()) else {
        return;
    };
    let Ok(bytes) = serde_json::to_vec_pretty(figures) else {
        return;
    };
    if let Err(error) = files::write_atomically(folder, &name.to_string_lossy(), &bytes) {
        tracing::debug!(%error, "the machine's figures were not kept");
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
    async fn callers_who_leave_start_no_second_measurement() {
        static MEASURED: AtomicU32 = AtomicU32::new(0);
        fn slowly() -> Result<MachineFigures, MachineError> {
            MEASURED.fetch_add(1, Ordering::SeqCst);
            std::thread::sleep(Duration::from_millis(100));
            crate::estimate::machine::checked(figures())
        }
        let kept = CalibrationCache {
            measure: slowly,
            ..CalibrationCache::open(None)
        };
        for _ in 0..3 {
            // Asks, and leaves at once.
            tokio::select! {
                biased;
                _ = kept.wait() => {}
                () = std::future::ready(()) => {}
            }
        }
        assert_eq!(kept.wait().await, Some(figures()));
        assert_eq!(MEASURED.load(Ordering::SeqCst), 1);
    }

    #[tokio::test]
    async fn a_machine_that_could_not_be_measured_is_left_alone_for_a_while() {
        static TRIED: AtomicU32 = AtomicU32::new(0);
        fn in_vain() -> Result<MachineFigures, MachineError> {
            TRIED.fetch_add(1, Ordering::SeqCst);
            Err(MachineError::Example("preset"))
        }
        let kept = CalibrationCache {
            measure: in_vain,
            ..CalibrationCache::open(None)
        };
        assert_eq!((kept.wait().await, kept.wait().await), (None, None));
        assert_eq!(TRIED.load(Ordering::SeqCst), 1);
    }

    #[test]
    fn kept_figures_that_no_machine_has_are_not_taken() {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let file = folder.path().join("machine.json");
        write(&file, &figures());
        assert_eq!(
            CalibrationCache::open(Some(file.clone())).known(),
            Some(&figures())
        );
        let wrong = MachineFigures {
            increment_s: -1.0,
            ..figures()
        };
        write(&file, &wrong);
        assert_eq!(CalibrationCache::open(Some(file)).known(), None);
    }

    #[test]
    fn a_machine_is_measured_once_for_each_program() {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let file = folder.path().join("cache").join("machine.json");
        let first = CalibrationCache::open(Some(file.clone()));
        assert_eq!(first.known(), None);
        let figures = first.measured().expect("it can be measured").clone();
        assert!(figures.increment_s > 0.0 && figures.condensation_dof_s >= 0.0);
        assert_eq!(
            CalibrationCache::open(Some(file.clone())).known(),
            Some(&figures)
        );

        let other = MachineFigures {
            program: "another".to_owned(),
            ..figures
        };
        write(&file, &other);
        assert_eq!(CalibrationCache::open(Some(file)).known(), None);
    }
}
