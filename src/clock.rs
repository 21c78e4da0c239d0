//! Where polygon insertion spends its time (paper, Table 2). Off unless somebody asks: then a task costs the look at an
//! `Option`, and the clock is never read.

use std::time::Instant;

/// What polygon insertion does: rows (1) to (6) of the paper's Table 2.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Task {
    /// (1) Cavities: constructing the Delaunay tetrahedralization of a cavity's vertices.
    CavityDelaunay,
    /// (2) Cavities: identifying the faces of the cavity in it, and swallowing tetrahedra until all are there.
    CavityFaces,
    /// (3) Cavities: identifying its faces on the polygon.
    PolygonFaces,
    /// (4) Cavities: leaving out what is not in the cavity, and merging the rest with the mesh.
    Merging,
    /// (5) Flips: computing flip times and putting flips on the queue.
    Queueing,
    /// (6) Flips: taking flips off the queue and performing them.
    Flipping,
}

const TASKS: usize = 6;

/// Seconds by task.
#[derive(Clone, Copy, Default, PartialEq, Debug)]
pub struct TaskSeconds([f64; TASKS]);

impl TaskSeconds {
    /// Of one task.
    pub fn of(&self, task: Task) -> f64 {
        self.0[task as usize]
    }

    /// Both together.
    #[must_use]
    pub fn and(self, other: TaskSeconds) -> TaskSeconds {
        TaskSeconds(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

/// A clock that tells tasks apart. The default one is off.
#[derive(Clone, Copy, Default, Debug)]
pub struct TaskClock {
    /// When the task that goes on was begun, if the clock is on.
    begun: Option<Instant>,
    seconds: TaskSeconds,
}

impl TaskClock {
    /// A clock that is on.
    pub fn started() -> TaskClock {
        TaskClock {
            begun: Some(Instant::now()),
            seconds: TaskSeconds::default(),
        }
    }

    /// What was done so far belongs to no task; a task begins.
    #[inline]
    pub fn begin(&mut self) {
        if self.begun.is_some() {
            self.begun = Some(Instant::now());
        }
    }

    /// What was done since the beginning, or the end of the last task, was this.
    #[inline]
    pub fn end(&mut self, task: Task) {
        if let Some(begun) = self.begun {
            let now = Instant::now();
            self.seconds.0[task as usize] += (now - begun).as_secs_f64();
            self.begun = Some(now);
        }
    }

    /// So far.
    pub fn seconds(&self) -> TaskSeconds {
        self.seconds
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_add_up_if_the_clock_is_on() {
        let mut clock = TaskClock::default();
        clock.begin();
        clock.end(Task::Queueing);
        assert_eq!(clock.seconds(), TaskSeconds::default());
        let (start, mut clock) = (Instant::now(), TaskClock::started());
        for task in [Task::Queueing, Task::Flipping, Task::Queueing] {
            std::thread::sleep(std::time::Duration::from_millis(2));
            clock.end(task);
        }
        let all = start.elapsed().as_secs_f64();
        let seconds = clock.seconds();
        assert!(seconds.of(Task::Queueing) >= 0.004 && seconds.of(Task::Flipping) >= 0.002);
        assert!(seconds.of(Task::Queueing) + seconds.of(Task::Flipping) <= all);
        assert_eq!(seconds.of(Task::Merging), 0.0);
    }
}
