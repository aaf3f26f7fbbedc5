//! Turning points of a periodic motion.

/// Most turning points in a period: a cycle has at least one increment for each. Arbitrary.
pub const MOST_TURNS: usize = 16;
/// Part of the amplitude by which another turning point may lie beyond the first one: turning points of one height are found to less.
const ROUND_OFF: f64 = 1e-8;

/// Turning points in the order in which a period reaches them, from an outermost one on: the rightmost one of a motion that begins
/// to +x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurningPoints {
    x_mm: [f64; MOST_TURNS],
    count: usize,
}

impl TurningPoints {
    /// Turning points at these displacements, mm; `None` if they are fewer than two, more than [`MOST_TURNS`], do not go to and
    /// fro, or if one lies beyond the first or its mirror image.
    pub fn new(x_mm: &[f64]) -> Option<Self> {
        let (first, count) = (*x_mm.first()?, x_mm.len());
        let within = |x: &f64| x.abs() <= first.abs() * (1.0 + ROUND_OFF);
        if !(2..=MOST_TURNS).contains(&count)
            || !count.is_multiple_of(2)
            || !x_mm.iter().all(within)
        {
            return None;
        }
        let mut turns = Self {
            x_mm: [0.0; MOST_TURNS],
            count,
        };
        turns.x_mm[..count].copy_from_slice(x_mm);
        let alternates = turns.strokes().enumerate().all(|(stroke, (from, to))| {
            let recedes = (to - from) * first < 0.0;
            recedes == stroke.is_multiple_of(2) && (to - from).abs() > 0.0
        });
        alternates.then_some(turns)
    }

    /// The displacements, mm.
    pub fn as_slice(&self) -> &[f64] {
        &self.x_mm[..self.count]
    }

    /// Beginning and end of each stroke, mm; the last one ends where the first begins.
    pub fn strokes(&self) -> impl Iterator<Item = (f64, f64)> {
        let places = self.as_slice();
        let ends = places.iter().skip(1).chain(places.first());
        places.iter().copied().zip(ends.copied())
    }

    /// The motion to the other side first.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self {
            x_mm: self.x_mm.map(|x| -x),
            ..self
        }
    }

    /// Largest displacement, mm: that of the first one, negative if it lies at -x.
    pub fn amplitude_mm(&self) -> f64 {
        self.x_mm[0]
    }

    /// Returns `true` if they are two at the same distance from the middle.
    pub(crate) fn is_reciprocating(&self) -> bool {
        self.count == 2 && (self.x_mm[0] + self.x_mm[1]).abs() <= 0.0
    }

    /// Length of all strokes together, mm.
    pub(crate) fn path_mm(&self) -> f64 {
        self.strokes().map(|(from, to)| (to - from).abs()).sum()
    }

    /// Length of the shortest stroke, mm.
    pub(crate) fn shortest_mm(&self) -> f64 {
        let lengths = self.strokes().map(|(from, to)| (to - from).abs());
        lengths.fold(f64::INFINITY, f64::min)
    }

    /// Most strokes that pass one place.
    pub(crate) fn most_passes(&self) -> usize {
        let passes = |x: f64| {
            let passing = |&(from, to): &(f64, f64)| from.min(to) <= x && x < from.max(to);
            self.strokes().filter(passing).count()
        };
        // The number changes at turning points alone.
        let most = self.as_slice().iter().map(|x| passes(*x));
        most.max().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_go_to_and_fro_between_the_outermost_turning_points() {
        let turns = TurningPoints::new(&[1.0, -0.5, 0.25, -1.0]).expect("to and fro");
        let strokes: Vec<_> = turns.strokes().collect();
        assert_eq!(
            strokes,
            [(1.0, -0.5), (-0.5, 0.25), (0.25, -1.0), (-1.0, 1.0)]
        );
        assert!((turns.path_mm() - 5.5).abs() < 1e-15);
        assert!((turns.shortest_mm() - 0.75).abs() < 1e-15);
        assert_eq!(turns.most_passes(), 4);
        let reciprocating = TurningPoints::new(&[1.0, -1.0]).expect("to and fro");
        assert_eq!(reciprocating.most_passes(), 2);
        let mirrored = turns.mirrored();
        assert_eq!(TurningPoints::new(mirrored.as_slice()), Some(mirrored));
        for refused in [
            &[1.0][..],
            &[],
            &[1.0, -0.5, 0.25],
            &[1.0, -0.5, -0.6, -1.0],
            &[1.0, -1.0, 1.5, -1.0],
            &[0.5, -1.0],
            &[0.0, 0.0],
            &[1.0; 18],
        ] {
            assert_eq!(TurningPoints::new(refused), None, "{refused:?}");
        }
    }
}
