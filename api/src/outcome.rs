//! Outcome and phases of a solve.

use crate::enum_value::string_enum;

string_enum! {
    /// Outcome of a solve.
    Outcome {
        /// All cycles were computed.
        Completed = "completed",
        /// All cycles were computed, but the estimated error of worn depth or worn area exceeds the tolerance.
        OutsideTolerance = "outside_tolerance",
        /// A stop condition was met.
        StopCondition = "stop_condition",
        /// A body was worn through almost completely.
        WornThrough = "worn_through",
        /// A groove along a line was as deep as the slider's radius: its walls would overhang.
        DeeperThanRadius = "deeper_than_radius",
        /// Stopped by a request.
        Stopped = "stopped",
        /// The solver did not converge; `status_reason` contains its numbers.
        NotConverged = "not_converged",
        /// The workers of all attempts were lost.
        WorkerLost = "worker_lost",
        /// The solve exceeded the memory limit of its process.
        OutOfMemory = "out_of_memory",
        /// The job had not ended by its deadline.
        DeadlineExceeded = "deadline_exceeded",
    }
}

string_enum! {
    /// Stages of a solve.
    Stage {
        /// Meshes and operators of the unworn bodies.
        Meshing = "meshing",
        /// The run with the settings of the tolerance.
        Solving = "solving",
        /// Coarse companions of the run, which its error is estimated by.
        Companions = "companions",
        /// A finer run from cycle 0, because the error of the first one exceeds the tolerance.
        Refined = "refined",
    }
}

string_enum! {
    /// Phases of a solve.
    Phase {
        /// Geometry and meshes.
        Mesh = "mesh",
        /// Condensation of the operators.
        Condense = "condense",
        /// Contact increments and wear.
        Cycles = "cycles",
        /// Relocation of the mesh to the worn surface.
        Relocate = "relocate",
        /// Coarse companions of the run, which its error is estimated by.
        Companions = "companions",
    }
}
