//! SVG: closed paths, polygons, rectangles and circles as outlines of a plane drawing.
//!
//! W3C, Scalable Vector Graphics (SVG) 1.1: y points down there, and `viewBox` and `width` say how large a
//! unit is. Layers are those of Inkscape, else the outermost groups that have an id.

use super::{
    ImportOptions, Role,
    drawing::{CHORD, Drawing, Drawn, Point},
    raw::Raw,
    text::{self, shorten},
};
use base::error::{FindingCode, InputError, JsonPath};
use kurbo::{Affine, Arc, BezPath, Circle, Ellipse, PathEl, Shape, SvgArc, Vec2};
use roxmltree::{Document, Node, ParsingOptions};
use std::str::FromStr;
use svgtypes::{Length, LengthUnit, PathParser, PathSegment, PointsParser, Transform, ViewBox};

/// Where the names of Inkscape come from.
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// Elements whose content is not drawn where it stands.
const NOT_DRAWN: [&str; 9] =
    ["defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "style", "namedview"];

/// The layer of what is on none.
const NO_LAYER: &str = "drawing";

/// An element that is still to be looked at.
struct Next<'a> {
    node: Node<'a, 'a>,
    place: Affine,
    layer: Option<String>,
}

/// The blocks of an SVG file.
pub(super) fn read(bytes: &[u8], options: &ImportOptions) -> Result<Raw, InputError> {
    let content = String::from_utf8_lossy(text::unmarked(bytes));
    // Older drawings declare their document type.
    let declared = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&content, declared).map_err(|e| {
        let line = usize::try_from(e.pos().row).unwrap_or(1);
        text::error(line, format!("no valid XML: {e}"))
            .hint("the file may be cut off or damaged here")
    })?;
    let root = document.root_element();
    let mut raw = Raw::default();
    let up = page(root, options, &mut raw)?;
    let starts: Vec<usize> =
        std::iter::once(0).chain(content.match_indices('\n').map(|m| m.0 + 1)).collect();
    let line = |node: Node| starts.partition_point(|s| *s <= node.range().start);
    let mut drawing = Drawing::default();
    let mut stack = vec![Next { node: root, place: up, layer: None }];
    while let Some(Next { node, place, layer }) = stack.pop() {
        let name = node.tag_name().name();
        let hidden = node.attribute("display") == Some("none")
            || node.attribute("style").is_some_and(|s| s.replace(' ', "").contains("display:none"));
        if NOT_DRAWN.contains(&name) {
            continue;
        }
        if hidden {
            *drawing.skipped.entry(format!("hidden {}", shorten(name))).or_default() += 1;
            continue;
        }
        let fault = |e: &dyn std::fmt::Display, what: &str| {
            text::error(line(node), format!("{what}: {e}")).hint("the file may be damaged here")
        };
        let place = match node.attribute("transform") {
            Some(t) => {
                let t = Transform::from_str(t).map_err(|e| fault(&e, "transform"))?;
                place * Affine::new([t.a, t.b, t.c, t.d, t.e, t.f])
            }
            None => place,
        };
        if matches!(name, "g" | "svg" | "a" | "switch") {
            let layer = layer_of(node, layer);
            let children = node.children().filter(Node::is_element);
            let next = children.map(|node| Next { node, place, layer: layer.clone() });
            let from = stack.len();
            stack.extend(next);
            stack[from..].reverse();
            continue;
        }
        let layer = layer.unwrap_or_else(|| NO_LAYER.into());
        let id = node.attribute((INKSCAPE, "label")).or(node.attribute("id"));
        let id =
            format!("{layer}-{}", id.map_or_else(|| format!("line{}", line(node)), str::to_string));
        let drawn = Drawn { id, layer, line: Some(line(node)), what: () };
        let number = |key: &str| match node.attribute(key) {
            Some(word) => Length::from_str(word)
                .map(|l| l.number)
                .map_err(|e| fault(&e, &format!("{key} {:?}", shorten(word)))),
            None => Ok(0.0),
        };
        let path = match name {
            "path" => path(node.attribute("d").unwrap_or_default()).map_err(|e| fault(&e, "d"))?,
            "polygon" | "polyline" => {
                let mut path = BezPath::new();
                for (x, y) in PointsParser::from(node.attribute("points").unwrap_or_default()) {
                    match path.elements().is_empty() {
                        true => path.move_to((x, y)),
                        false => path.line_to((x, y)),
                    }
                }
                if name == "polygon" && !path.elements().is_empty() {
                    path.close_path();
                }
                path
            }
            "rect" => {
                if node.has_attribute("rx") || node.has_attribute("ry") {
                    *drawing.skipped.entry("rect with round corners".into()).or_default() += 1;
                    continue;
                }
                let (x, y) = (number("x")?, number("y")?);
                let size = (number("width")?, number("height")?);
                kurbo::Rect::from_origin_size((x, y), size).to_path(0.1)
            }
            "line" => {
                let ends = [(number("x1")?, number("y1")?), (number("x2")?, number("y2")?)];
                let what = ends.map(|p| point(place * kurbo::Point::from(p)));
                drawing.lines.push(drawn.with(what));
                continue;
            }
            "circle" | "ellipse" => {
                let center = kurbo::Point::new(number("cx")?, number("cy")?);
                let role = options.layers.get(&drawn.layer).map(|r| r.role);
                if role == Some(Role::Load) {
                    drawing.points.push(drawn.with(point(place * center)));
                    continue;
                }
                drawing.arcs += 1;
                let radii = match name {
                    "circle" => Vec2::new(number("r")?, number("r")?),
                    _ => Vec2::new(number("rx")?, number("ry")?),
                };
                let tolerance = CHORD * radii.hypot();
                match radii.x == radii.y {
                    true => Circle::new(center, radii.x).to_path(tolerance),
                    false => Ellipse::new(center, radii, 0.0).to_path(tolerance),
                }
            }
            other => {
                *drawing.skipped.entry(shorten(other)).or_default() += 1;
                continue;
            }
        };
        outlines(&(place * path), &drawn, &mut drawing);
    }
    drawing.into_raw(raw, options)
}

impl Drawn<()> {
    fn with<T>(&self, what: T) -> Drawn<T> {
        Drawn { id: self.id.clone(), layer: self.layer.clone(), line: self.line, what }
    }
}

fn point(p: kurbo::Point) -> Point {
    [p.x, p.y]
}

/// The layer of what stands in a group.
fn layer_of(node: Node, outer: Option<String>) -> Option<String> {
    let name = || node.attribute((INKSCAPE, "label")).or(node.attribute("id")).map(str::to_string);
    match node.attribute((INKSCAPE, "groupmode")) {
        Some("layer") => name().or(outer),
        _ if node.tag_name().name() == "g" => outer.or_else(name),
        _ => outer,
    }
}

/// Turns y up, and says how large a unit is.
fn page(root: Node, options: &ImportOptions, raw: &mut Raw) -> Result<Affine, InputError> {
    if root.tag_name().name() != "svg" {
        let message =
            format!("no SVG: its outermost element is {:?}", shorten(root.tag_name().name()));
        return Err(
            InputError::at(JsonPath::root(), message).hint("check that this is the right file")
        );
    }
    let page = root.attribute("viewBox").and_then(|v| ViewBox::from_str(v).ok());
    let width = root.attribute("width").and_then(|w| Length::from_str(w).ok());
    let unit = width.and_then(|w| {
        let metres = match w.unit {
            LengthUnit::Mm => 1e-3,
            LengthUnit::Cm => 1e-2,
            LengthUnit::In => 0.0254,
            LengthUnit::Pt => 0.0254 / 72.0,
            LengthUnit::Pc => 0.0254 / 6.0,
            _ => return None,
        };
        Some((w, page.map_or(metres, |p| w.number * metres / p.w)))
    });
    raw.unit = unit.map(|u| u.1).filter(|u| u.is_finite() && *u > 0.0);
    let (code, text) = match (options.scale, raw.unit) {
        (Some(_), _) => (FindingCode::Converted, "units of the drawing: the scale given is used".into()),
        (None, Some(size)) => (
            FindingCode::Converted,
            format!("units of the drawing: its width is {}, 1 = {size} m", root.attribute("width").unwrap_or_default()),
        ),
        (None, None) => (
            FindingCode::Missing,
            "the drawing names no unit (its width is none or in pixels), taken as metres: `--scale 0.001` if it is in mm".to_string(),
        ),
    };
    raw.say(code, text);
    let height = page.map_or(0.0, |p| p.y + p.h);
    Ok(Affine::new([1.0, 0.0, 0.0, -1.0, 0.0, height]))
}

/// A path with arcs and curves as cubic ones.
fn path(text: &str) -> Result<BezPath, svgtypes::Error> {
    let mut path = BezPath::new();
    let (mut at, mut start) = (kurbo::Point::ZERO, kurbo::Point::ZERO);
    // The last control point, of a cubic or of a quadratic curve, which smooth ones mirror.
    let (mut cubic, mut quadratic) = (None, None);
    for segment in PathParser::from(text) {
        let segment = segment?;
        let origin = if segment.is_abs() { Vec2::ZERO } else { at.to_vec2() };
        let abs = |x: f64, y: f64| kurbo::Point::new(x, y) + origin;
        let mirrored = |control: Option<kurbo::Point>| control.map_or(at, |c| at + (at - c));
        let (was_cubic, was_quadratic) = (cubic.take(), quadratic.take());
        let to = match segment {
            PathSegment::MoveTo { x, y, .. } => {
                start = abs(x, y);
                path.move_to(start);
                start
            }
            PathSegment::LineTo { x, y, .. } => line(&mut path, abs(x, y)),
            PathSegment::HorizontalLineTo { x, .. } => line(&mut path, (x + origin.x, at.y).into()),
            PathSegment::VerticalLineTo { y, .. } => line(&mut path, (at.x, y + origin.y).into()),
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                let control = *cubic.insert(abs(x2, y2));
                path.curve_to(abs(x1, y1), control, abs(x, y));
                abs(x, y)
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let control = *cubic.insert(abs(x2, y2));
                path.curve_to(mirrored(was_cubic), control, abs(x, y));
                abs(x, y)
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                path.quad_to(*quadratic.insert(abs(x1, y1)), abs(x, y));
                abs(x, y)
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                path.quad_to(*quadratic.insert(mirrored(was_quadratic)), abs(x, y));
                abs(x, y)
            }
            PathSegment::EllipticalArc {
                rx, ry, x_axis_rotation, large_arc, sweep, x, y, ..
            } => {
                let to = abs(x, y);
                let arc = SvgArc {
                    from: at,
                    to,
                    radii: Vec2::new(rx, ry),
                    x_rotation: x_axis_rotation.to_radians(),
                    large_arc,
                    sweep,
                };
                match Arc::from_svg_arc(&arc) {
                    Some(arc) => {
                        path.extend(arc.append_iter(CHORD * arc.radii.hypot()));
                        end_at(path.elements().len(), &mut path, to);
                        to
                    }
                    None => line(&mut path, to),
                }
            }
            PathSegment::ClosePath { .. } => {
                path.close_path();
                start
            }
        };
        at = to;
    }
    Ok(path)
}

fn line(path: &mut BezPath, to: kurbo::Point) -> kurbo::Point {
    path.line_to(to);
    to
}

/// The end of an arc as it was written: computed ones differ in last bits, and joints would not close.
fn end_at(count: usize, path: &mut BezPath, to: kurbo::Point) {
    if let Some(PathEl::CurveTo(_, _, end)) = path.elements_mut().get_mut(count.wrapping_sub(1)) {
        *end = to;
    }
}

/// Rings of a path, and what of it does not close.
fn outlines(path: &BezPath, drawn: &Drawn<()>, drawing: &mut Drawing) {
    let bounds = path.bounding_box();
    let size = bounds.width().hypot(bounds.height());
    let bent = |e: &&PathEl| matches!(e, PathEl::CurveTo(..) | PathEl::QuadTo(..));
    drawing.arcs += path.elements().iter().filter(bent).count();
    let mut rings: Vec<(Vec<Point>, bool)> = Vec::new();
    kurbo::flatten(path, CHORD * size, |element| match element {
        PathEl::MoveTo(p) => rings.push((vec![point(p)], false)),
        PathEl::LineTo(p) => match rings.last_mut() {
            Some((ring, false)) => ring.push(point(p)),
            // After a closed ring the next begins where that began.
            last => {
                let begin = last.and_then(|r| r.0.first().copied());
                rings.push((begin.into_iter().chain([point(p)]).collect(), false));
            }
        },
        PathEl::ClosePath => rings.last_mut().into_iter().for_each(|r| r.1 = true),
        _ => {}
    });
    for (mut ring, closed) in rings {
        let back = ring.len() > 1 && ring.first() == ring.last();
        if back {
            ring.pop();
        }
        match ring[..] {
            [] | [_] => {}
            [a, b] if !closed && !back => drawing.lines.push(drawn.with([a, b])),
            _ if (closed || back) && ring.len() > 2 => drawing.outlines.push(drawn.with(ring)),
            [first, ..] => drawing.open.push(drawn.with(first)),
        }
    }
}
