//! Scatter plots as SVG, with linear or logarithmic axes. The same plot gives the same bytes.

use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;
use thiserror::Error;

/// A plot could not be drawn.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PlotError {
    /// There is no point at all.
    #[error("no points to plot")]
    NoPoints,
    /// A point that is not finite, or not positive on logarithmic axes.
    #[error("series `{series}`, point {index}: ({x}, {y}) has no place on {scale:?} axes")]
    Point {
        /// The name of the series.
        series: String,
        /// The place of the point in it.
        index: usize,
        /// Its abscissa.
        x: f64,
        /// Its ordinate.
        y: f64,
        /// The axes.
        scale: Scale,
    },
    /// The drawing library refused.
    #[error("drawing failed: {0}")]
    Drawing(String),
}

/// The scale of both axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Linear; an axis starts at 0 if no value is negative.
    Linear,
    /// Logarithmic.
    Log,
}

/// A named set of points, drawn in one colour and shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The name in the legend.
    pub name: String,
    /// The points (x, y).
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// A series.
    pub fn new(name: impl ToString, points: impl IntoIterator<Item = (f64, f64)>) -> Series {
        let points = points.into_iter().collect();
        Series {
            name: name.to_string(),
            points,
        }
    }

    /// n log n at the abscissas of this series, through its first point.
    pub fn n_log_n(&self) -> Series {
        let points = self.points.iter().map(|&(n, _)| {
            let (n0, t0) = self.points[0];
            (n, t0 * n * n.ln() / (n0 * n0.ln()))
        });
        Series::new("n log n", points)
    }
}

/// A scatter plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Above the plot.
    pub title: &'static str,
    /// Below the x axis.
    pub x_label: &'static str,
    /// Beside the y axis.
    pub y_label: &'static str,
    /// The scale of the axes.
    pub scale: Scale,
    /// The points. A method, or a family, has the same colour and shape in all plots.
    pub series: Vec<Series>,
    /// Grey lines through their points, for comparison.
    pub guides: Vec<Series>,
}

/// Width and height of a plot in pixels.
const SIZE: (u32, u32) = (880, 480);

/// The part of the width that is the legend's, beside the data.
const LEGEND: u32 = 190;

/// What plots show, in pairs of a name and the place of its colour and shape.
const KNOWN: [(&str, usize); 18] = [
    ("flip filtered", 0),
    ("flip f64:plain", 1),
    ("cavity", 2),
    ("flip f32", 3),
    ("flip exact", 4),
    ("flip rug", 5),
    ("TetGen cavity", 6),
    ("TetGen flips", 7),
    ("random", 0),
    ("lattice", 1),
    ("sphere", 2),
    ("prism", 3),
    ("crossing-planes", 4),
    ("boxes", 5),
    ("walls", 6),
    ("near-coplanar", 7),
    ("needles", 8),
    ("rectangle", 9),
];

/// Okabe & Ito's colours that the colour-blind can tell apart, but for their yellow, which white swallows; then four
/// darker ones. Series whose colours are alike differ in shape.
const COLORS: [RGBColor; 10] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(130, 75, 20),
    RGBColor(115, 60, 190),
    RGBColor(120, 120, 120),
];

impl Plot {
    /// The plot as the text of an SVG file.
    ///
    /// # Errors
    /// If there is no point, or one that the axes cannot show.
    pub fn svg(&self) -> Result<String, PlotError> {
        let x = self.range(|p| p.0)?;
        let y = self.range(|p| p.1)?;
        let mut text = String::new();
        let drawn = match self.scale {
            Scale::Linear => self.draw::<RangedCoordf64, _>(&mut text, x, y),
            Scale::Log => self.draw::<LogCoord<f64>, _>(&mut text, x.log_scale(), y.log_scale()),
        };
        drawn.map_err(|error| PlotError::Drawing(error.to_string()))?;
        Ok(text)
    }

    /// The range of one axis, with some room.
    fn range(&self, along: impl Fn(&(f64, f64)) -> f64) -> Result<Range<f64>, PlotError> {
        let positive = |x: f64| x > 0.0 || self.scale == Scale::Linear;
        let shown = |x: f64| x.is_finite() && positive(x);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for series in self.series.iter().chain(&self.guides) {
            for (index, point) in series.points.iter().enumerate() {
                if !shown(point.0) || !shown(point.1) {
                    return Err(PlotError::Point {
                        series: series.name.clone(),
                        index,
                        x: point.0,
                        y: point.1,
                        scale: self.scale,
                    });
                }
                low = low.min(along(point));
                high = high.max(along(point));
            }
        }
        if low > high {
            return Err(PlotError::NoPoints);
        }
        Ok(match self.scale {
            Scale::Log => low / 1.25..high * 1.25,
            Scale::Linear => {
                let (low, high) = (low.min(0.0), high.max(0.0));
                let room = if low == high {
                    1.0
                } else {
                    (high - low) * 0.05
                };
                (if low < 0.0 { low - room } else { 0.0 })..high + room
            }
        })
    }

    /// The text of a tick; on logarithmic axes only 1, 2 and 5 of each decade have one, lest they overlap.
    fn tick(&self, x: f64) -> String {
        let digits = format!("{x:.5e}");
        let named = ["1.00000", "2.00000", "5.00000"];
        if self.scale == Scale::Log && !named.iter().any(|n| digits.starts_with(n)) {
            return String::new();
        }
        tick(x)
    }

    fn draw<C, R>(
        &self,
        text: &mut String,
        x: R,
        y: R,
    ) -> Result<(), DrawingAreaErrorKind<std::io::Error>>
    where
        C: Ranged<ValueType = f64> + ValueFormatter<f64>,
        R: AsRangedCoord<CoordDescType = C, Value = f64>,
    {
        let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let (left, right) = root.split_horizontally(SIZE.0 - LEGEND);
        let mut chart = ChartBuilder::on(&left)
            .caption(self.title, ("sans-serif", 20))
            .margin(12)
            .x_label_area_size(48)
            .y_label_area_size(72)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .x_desc(self.x_label)
            .y_desc(self.y_label)
            .x_label_formatter(&|x| self.tick(*x))
            .y_label_formatter(&|y| self.tick(*y))
            .axis_desc_style(("sans-serif", 15))
            .label_style(("sans-serif", 13))
            .light_line_style(WHITE.mix(0.0))
            .bold_line_style(BLACK.mix(0.12))
            .draw()?;
        let grey = BLACK.mix(0.45).stroke_width(1);
        let mut keys = Vec::new();
        for guide in &self.guides {
            chart.draw_series(LineSeries::new(guide.points.iter().copied(), grey))?;
            keys.push((&guide.name, None));
        }
        for (i, series) in self.series.iter().enumerate() {
            let style = self.style(i);
            let points = series.points.iter().copied();
            let (filled, line) = (color(style).filled(), color(style).stroke_width(2));
            match style % 3 {
                0 => drop(chart.draw_series(points.map(|p| Circle::new(p, 3, filled)))?),
                1 => drop(chart.draw_series(points.map(|p| TriangleMarker::new(p, 4, filled)))?),
                _ => drop(chart.draw_series(points.map(|p| Cross::new(p, 3, line)))?),
            }
            keys.push((&series.name, Some(style)));
        }
        for ((name, style), y) in keys.into_iter().zip((56i32..).step_by(24)) {
            let at = (14, y);
            match style {
                None => right.draw(&PathElement::new([(4, y), (24, y)], grey))?,
                Some(i) if i % 3 == 0 => right.draw(&Circle::new(at, 3, color(i).filled()))?,
                Some(i) if i % 3 == 1 => {
                    right.draw(&TriangleMarker::new(at, 4, color(i).filled()))?
                }
                Some(i) => right.draw(&Cross::new(at, 3, color(i).stroke_width(2)))?,
            }
            right.draw(&Text::new(name.clone(), (32, y - 8), ("sans-serif", 14)))?;
        }
        root.present()
    }

    /// The place of a series' colour and shape: its own, if it is known, otherwise the first that no other has.
    fn style(&self, i: usize) -> usize {
        let known = |series: &Series| KNOWN.iter().find(|k| k.0 == series.name).map(|k| k.1);
        let taken: Vec<usize> = self.series.iter().filter_map(known).collect();
        let unknown = self.series[..i]
            .iter()
            .filter(|s| known(s).is_none())
            .count();
        let mut free = (0..).filter(|style| !taken.contains(style));
        known(&self.series[i]).unwrap_or_else(|| free.nth(unknown).expect("endlessly many"))
    }
}

/// The colour of a style.
fn color(style: usize) -> RGBColor {
    COLORS[style % COLORS.len()]
}

/// A tick's number: plain where that is short, otherwise with an exponent. Rounded to 6 digits, since ticks are sums of
/// a step that no double holds.
fn tick(x: f64) -> String {
    if x == 0.0 {
        return "0".to_string();
    }
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    let (plain, exponent) = (format!("{rounded}"), format!("{rounded:e}"));
    if plain.len() <= 7 { plain } else { exponent }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(scale: Scale, points: &[&[(f64, f64)]]) -> Plot {
        let series = points.iter().enumerate();
        Plot {
            title: "Time < size & more",
            x_label: "crossing tetrahedra",
            y_label: "seconds",
            scale,
            series: series
                .map(|(i, p)| Series::new(format!("method {i}"), p.to_vec()))
                .collect(),
            guides: Vec::new(),
        }
    }

    const POINTS: &[&[(f64, f64)]] = &[
        &[(102.0, 1.0), (1840.0, 17.5)],
        &[(102.0, 0.9)],
        &[(500.0, 4.0)],
    ];

    #[test]
    fn all_points_and_all_text() {
        let texts = [
            "Time &lt; size &amp; more",
            "crossing tetrahedra",
            "seconds",
            "method 0",
            "method 2",
        ];
        let svgs = [Scale::Linear, Scale::Log].map(|scale| {
            let svg = plot(scale, POINTS).svg().unwrap();
            assert!(texts.iter().all(|text| svg.contains(text)));
            // Two points and one key in the legend.
            assert_eq!(svg.matches("<circle").count(), 3);
            assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
            assert_eq!(
                svg,
                plot(scale, POINTS).svg().unwrap(),
                "the same bytes again"
            );
            svg
        });
        assert_ne!(svgs[0], svgs[1]);
    }

    #[test]
    fn guides_are_lines() {
        let mut plot = plot(Scale::Log, POINTS);
        let guide = Series::new("", [(10.0, 1.0), (100.0, 15.0)]).n_log_n();
        assert_eq!(guide.points[0], (10.0, 1.0));
        // Ten times as many, twice the logarithm.
        assert!((guide.points[1].1 - 20.0).abs() < 1e-9);
        plot.guides = vec![Series::new("n log n", [(102.0, 1.0), (1e4, 200.0)])];
        assert_eq!(plot.range(|p| p.0).map(|r| r.end), Ok(1.25e4));
        let svg = plot.svg().unwrap();
        assert!(svg.contains("n log n") && svg.matches("<polyline").count() > 1);
    }

    #[test]
    fn a_method_has_one_style_everywhere_and_no_two_share_one() {
        let of = |names: &[&str]| {
            let mut plot = plot(Scale::Linear, POINTS);
            plot.series = names.iter().map(|n| Series::new(n, [(1.0, 1.0)])).collect();
            (0..names.len()).map(|i| plot.style(i)).collect::<Vec<_>>()
        };
        assert_eq!(of(&["cavity", "flip exact"]), [2, 4]);
        assert_eq!(
            of(&["flip exact", "x", "cavity", "y", "flip filtered"]),
            [4, 1, 2, 3, 0]
        );
    }

    #[test]
    fn points_without_a_place() {
        assert_eq!(
            plot(Scale::Log, &[&[], &[]]).svg(),
            Err(PlotError::NoPoints)
        );
        let bad = [
            (Scale::Log, 1.0, 0.0),
            (Scale::Log, -1.0, 1.0),
            (Scale::Linear, f64::INFINITY, 1.0),
        ];
        for (scale, x, y) in bad {
            let error = plot(scale, &[&[(1.0, 1.0)], &[(2.0, 2.0), (x, y)]])
                .svg()
                .unwrap_err();
            let series = "method 1".to_string();
            assert_eq!(
                error,
                PlotError::Point {
                    series,
                    index: 1,
                    x,
                    y,
                    scale
                }
            );
        }
        for scale in [Scale::Linear, Scale::Log] {
            assert!(
                plot(scale, &[&[(3.0, 1e-6)]]).svg().is_ok(),
                "a single point has axes"
            );
        }
        assert!(plot(Scale::Linear, &[&[(0.0, 0.0)]]).svg().is_ok());
    }

    #[test]
    fn ranges_have_room_and_ticks_are_few_and_short() {
        assert_eq!(plot(Scale::Linear, POINTS).range(|p| p.0), Ok(0.0..1932.0));
        let log = plot(Scale::Log, &[&[(10.0, 1.0), (1000.0, 1.0)]]);
        assert_eq!(log.range(|p| p.0), Ok(8.0..1250.0));
        let texts = [0.1, 0.2, 0.3, 4.0, 500.0, 900.0, 1000.0].map(|x| log.tick(x));
        assert_eq!(texts, ["0.1", "0.2", "", "", "500", "", "1000"]);
        assert_eq!(plot(Scale::Linear, &[]).tick(900.0), "900");
        let texts = [0.0, 0.1 + 0.2, 1500.0, 1e-6, 2.5e-5, 1e9].map(tick);
        assert_eq!(texts, ["0", "0.3", "1500", "1e-6", "2.5e-5", "1e9"]);
    }
}
