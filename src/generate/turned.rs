//! What a lathe or a drill makes: bores, counterbores and bosses on a plane face, along a coordinate axis.
//!
//! A [`Turned`] is a stack of prisms over similar regular polygons of decreasing radius. Its walls are parallel to the
//! axis and its shelves across it, so that all its facets are exactly planar. It adds its first outline to the face it
//! stands on.

use super::draft::{Draft, Loop, placed};

/// A recess or a boss.
pub(super) struct Turned<'a> {
    /// The axis it is parallel to.
    pub axis: usize,
    /// The centre, across the axis.
    pub centre: [f64; 2],
    /// The polygon of radius 1.
    pub outline: &'a [[f64; 2]],
    /// Where on the axis the face is.
    pub face: f64,
    /// Radii, decreasing, and how far along the axis the wall of that radius goes.
    pub steps: &'a [(f64, f64)],
    /// Whether the last step ends in a face of its own; otherwise it ends in one that is drawn elsewhere.
    pub closed: bool,
}

impl Turned<'_> {
    /// Draws the walls, the shelves between them and the end.
    pub fn draw(&self, draft: &mut Draft) {
        let mut from = self.face;
        for (i, &(_, to)) in self.steps.iter().enumerate() {
            let outline = self.outline(i);
            draft.walls(self.axis, &outline, [from, to]);
            if i + 1 < self.steps.len() {
                let shelf = [outline, self.outline(i + 1)];
                draft.plane(self.axis, to, &shelf, &[self.centre]);
            } else if self.closed {
                draft.plane(self.axis, to, &[outline], &[]);
            }
            from = to;
        }
    }

    /// The outline of a step.
    pub fn outline(&self, step: usize) -> Loop {
        placed(self.outline, self.centre, self.steps[step].0)
    }
}

/// A plane face with features on it.
pub(super) struct Face {
    /// The axis it lies across.
    pub axis: usize,
    /// Where on that axis.
    pub at: f64,
    /// Its outline, then those of the features.
    pub outlines: Vec<Loop>,
    /// The centres of the features.
    pub centres: Vec<[f64; 2]>,
}

impl Face {
    /// A face without features.
    pub fn new(axis: usize, at: f64, outline: Loop) -> Face {
        Face {
            axis,
            at,
            outlines: vec![outline],
            centres: Vec::new(),
        }
    }

    /// Leaves an outline open.
    pub fn open(&mut self, outline: Loop, centre: [f64; 2]) {
        self.outlines.push(outline);
        self.centres.push(centre);
    }

    /// Draws a feature and leaves the face open there.
    pub fn put(
        &mut self,
        draft: &mut Draft,
        centre: [f64; 2],
        outline: &[[f64; 2]],
        steps: &[(f64, f64)],
    ) {
        let turned = Turned {
            axis: self.axis,
            centre,
            outline,
            face: self.at,
            steps,
            closed: true,
        };
        turned.draw(draft);
        self.open(turned.outline(0), centre);
    }

    /// Draws the face.
    pub fn draw(self, draft: &mut Draft) {
        draft.plane(self.axis, self.at, &self.outlines, &self.centres);
    }
}
