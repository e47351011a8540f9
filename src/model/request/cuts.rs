//! Cuts: the part of the modelling space that stays, and which of its faces are sections. Draws nothing.

use crate::diagnostic::{Category, Diagnostic};
use crate::picture::View;

use super::subject::Subject;
use super::{Cut, Half};

impl Subject {
    /// The same solid with the parts beyond some planes taken away, where it is capped. A cut that does not say which half stays takes away
    /// the one on the side of the eye; where the eye looks along the plane the half above.
    ///
    /// # Errors
    /// If this is no solid, a plane does not cut its space, or nothing is left.
    pub fn cut(mut self, cuts: &[Cut], view: &View) -> Result<Self, Diagnostic> {
        if cuts.is_empty() {
            return Ok(self);
        }
        if self.axes.len() != 3 {
            let title = format!("`{}` has {} axes here, and a cut goes through a solid", self.name, self.axes.len());
            let help = "a section is a figure of its own: --at x3=0";
            return Err(Diagnostic::error("no-cut", title).category(Category::Usage).help(help));
        }
        let middle = [0, 1, 2].map(|k| 0.5 * (self.axes[k].range[0] + self.axes[k].range[1]));
        let [.., forward] = view.about(middle).axes();
        let whole = self.bounds();
        for cut in cuts {
            let (c, at) = (cut.coordinate, cut.value);
            let Some(k) = self.axes.iter().position(|axis| axis.coordinate == c) else {
                let axes: Vec<String> = self.axes.iter().map(|axis| axis.coordinate.to_string()).collect();
                let title = format!("{c} is no axis of `{}`, which could be cut", self.name);
                let help = format!("its axes are {}", axes.join(", "));
                return Err(Diagnostic::error("no-axis", title).category(Category::Usage).help(help));
            };
            let [lo, hi] = whole[k];
            if !(lo < at && at < hi) {
                let title = format!("a cut at {c} = {at} lies outside of the modelling space, {c} from {lo} to {hi}");
                return Err(Diagnostic::error("no-cut", title).category(Category::Usage).help("cut within it"));
            }
            // An eye that looks up the axis stands below.
            let keep = cut.keep.unwrap_or(if forward[k] > 1e-9 { Half::Above } else { Half::Below });
            let range = &mut self.axes[k].range;
            match keep {
                Half::Below => (range[1], self.cut[k][1]) = (range[1].min(at), true),
                Half::Above => (range[0], self.cut[k][0]) = (range[0].max(at), true),
            }
            if range[0] >= range[1] {
                let title = format!("the cuts along {c} leave nothing of the modelling space");
                let help = "each cut takes away a half: keep a slab with --cut 'x1>0' --cut 'x1<1'";
                return Err(Diagnostic::error("no-cut", title).category(Category::Usage).help(help));
            }
        }
        let (axes, cut) = (self.axes.clone(), self.cut);
        for other in &mut self.beside {
            (other.axes, other.cut) = (axes.clone(), cut);
        }
        Ok(self)
    }
}
