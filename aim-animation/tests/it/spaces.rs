use aim_animation::glam::{DVec2, Vec2};
use aim_animation::{BlendLine, BlendPlane, SpaceError};

use crate::common::Rng;

#[test]
fn a_line_agrees_with_its_definition() {
    let mut rng = Rng(1);
    for _ in 0..2000 {
        let count = 1 + rng.below(6);
        let mut places: Vec<f32> = (0..count).map(|_| rng.between(-5.0, 5.0)).collect();
        places.sort_by(f32::total_cmp);
        let Ok(line) = BlendLine::new(places.clone()) else { continue };
        let at = rng.between(-7.0, 7.0);
        let mut weights = vec![9.0; count + 1];
        line.weights(at, &mut weights);
        // Hat functions: 1 at their own place, 0 at its neighbours, constant beyond the ends.
        for (k, place) in places.iter().map(|place| f64::from(*place)).enumerate() {
            let x = f64::from(at).clamp(f64::from(places[0]), f64::from(places[count - 1]));
            let toward = if x < place { k.checked_sub(1) } else { Some(k + 1).filter(|next| *next < count) };
            let hat = match toward {
                Some(next) => 1.0 - (x - place).abs() / (f64::from(places[next]) - place).abs(),
                None => f64::from(u8::from(x == place)),
            };
            assert!((f64::from(weights[k]) - hat.max(0.0)).abs() < 1e-5, "{places:?} at {at}: {weights:?}");
        }
        assert_eq!(weights[count], 0.0);
    }
    let line = BlendLine::new([1.0, 2.0]).unwrap();
    let mut weights = [0.0; 2];
    for (at, expected) in [(f32::NAN, [1.0, 0.0]), (f32::INFINITY, [0.0, 1.0]), (2.0, [0.0, 1.0]), (1.25, [0.75, 0.25])]
    {
        line.weights(at, &mut weights);
        assert_eq!(weights, expected, "{at}");
    }
    line.weights(2.0, &mut weights[..1]);
    assert_eq!(weights[0], 0.0, "the weights that there are");
    assert_eq!(BlendLine::new([]), Err(SpaceError::Empty));
    assert_eq!(BlendLine::new([0.0, f32::NAN]), Err(SpaceError::Place(1)));
    assert_eq!(BlendLine::new([0.0, 1.0, 1.0]), Err(SpaceError::Order(2)));
}

fn cross(a: DVec2, b: DVec2) -> f64 {
    a.perp_dot(b)
}

/// Returns the convex hull by gift wrapping, counterclockwise.
fn hull(points: &[DVec2]) -> Vec<DVec2> {
    let start = *points.iter().min_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))).unwrap();
    let mut hull = vec![start];
    loop {
        let last = *hull.last().unwrap();
        let others = points.iter().copied().filter(|point| *point != last);
        let next = others
            .reduce(|best, point| {
                let side = cross(best - last, point - last);
                let is_right = side < 0.0 || side == 0.0 && point.distance(last) > best.distance(last);
                if is_right { point } else { best }
            })
            .unwrap();
        if next == start {
            return hull;
        }
        hull.push(next);
        assert!(hull.len() <= points.len(), "the oracle goes round");
    }
}

fn nearest_within(hull: &[DVec2], at: DVec2) -> DVec2 {
    let edges = || (0..hull.len()).map(|k| (hull[k], hull[(k + 1) % hull.len()]));
    if edges().all(|(a, b)| cross(b - a, at - a) >= 0.0) {
        return at;
    }
    let on_edges = edges().map(|(a, b)| a + (b - a) * ((at - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0));
    on_edges.min_by(|p, q| p.distance(at).total_cmp(&q.distance(at))).unwrap()
}

/// Returns random points, or points of a grid, many of which are collinear or concyclic.
fn points(rng: &mut Rng, case: usize) -> Vec<Vec2> {
    let count = 3 + rng.below(10);
    let mut points: Vec<Vec2> = Vec::new();
    for _ in 0..count {
        let coordinate = |rng: &mut Rng| rng.between(-2.0, 2.0);
        let mut point = Vec2::new(coordinate(rng), coordinate(rng));
        if case % 2 == 1 {
            point = (point * 1.5).round();
        }
        if !points.contains(&point) {
            points.push(point);
        }
    }
    points
}

#[test]
fn a_plane_agrees_with_its_definition() {
    let mut rng = Rng(2);
    let mut judged = 0;
    for case in 0..1500 {
        let points = points(&mut rng, case);
        // Without negative zeros, which would sort separately.
        let exact: Vec<DVec2> = points.iter().map(|point| point.as_dvec2() + DVec2::ZERO).collect();
        let Ok(plane) = BlendPlane::new(points.clone()) else {
            let mut products = exact.iter().flat_map(|p| exact.iter().map(move |q| (*p, *q)));
            assert!(products.all(|(p, q)| cross(p - exact[0], q - exact[0]) == 0.0), "{points:?} are on no line");
            continue;
        };
        judged += 1;
        let hull = hull(&exact);
        // The triangles cover the hull without overlaps.
        let area = |corners: &[usize; 3]| {
            let [a, b, c] = corners.map(|corner| exact[corner]);
            0.5 * cross(b - a, c - a)
        };
        assert!(plane.triangles().iter().all(|triangle| area(triangle) > 0.0), "{points:?} {plane:?}");
        let covered: f64 = plane.triangles().iter().map(area).sum();
        let whole: f64 = (0..hull.len()).map(|k| 0.5 * cross(hull[k], hull[(k + 1) % hull.len()])).sum();
        assert!((covered - whole).abs() < 1e-9, "{points:?}: {covered} of {whole}");
        // Delaunay condition: no point lies inside a triangle's circumcircle.
        for triangle in plane.triangles() {
            let [a, b, c] = triangle.map(|corner| exact[corner]);
            let (u, v) = (b - a, c - a);
            let off = (u.perp() * -v.length_squared() + v.perp() * u.length_squared()) / (2.0 * cross(u, v));
            let (center, radius) = (a - off, off.length());
            let near = exact.iter().map(|point| point.distance(center)).fold(f64::INFINITY, f64::min);
            assert!((a.distance(center) - c.distance(center)).abs() < 1e-6 * radius.max(1.0), "the oracle's circle");
            assert!(near > radius * (1.0 - 1e-6), "{points:?}: {triangle:?}");
        }
        let mut weights = vec![0.0; points.len()];
        for _ in 0..20 {
            let at = Vec2::new(rng.between(-4.0, 4.0), rng.between(-4.0, 4.0));
            plane.weights(at, &mut weights);
            assert!(weights.iter().all(|weight| (0.0..=1.0).contains(weight)), "{weights:?}");
            assert!(weights.iter().filter(|weight| **weight > 0.0).count() <= 3);
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
            // Weights are linearly exact: the weighted mean of the points is the query, or the nearest point of the
            // hull.
            let place = exact.iter().zip(&weights).map(|(point, weight)| *point * f64::from(*weight)).sum::<DVec2>();
            let truth = nearest_within(&hull, at.as_dvec2());
            assert!(place.distance(truth) < 1e-5, "{points:?} at {at}: {place} {truth}");
        }
        for (k, point) in points.iter().enumerate() {
            plane.weights(*point, &mut weights);
            assert!((weights[k] - 1.0).abs() < 1e-6, "{points:?} at point {k}: {weights:?}");
        }
    }
    assert!(judged > 1000);
}

/// A small step changes the weights by little, also across edges and the rim.
#[test]
fn a_plane_is_continuous() {
    let mut rng = Rng(3);
    let plane = BlendPlane::new([
        Vec2::ZERO,
        Vec2::X,
        Vec2::new(0.3, 1.2),
        Vec2::new(-1.0, 0.4),
        Vec2::new(-0.7, -0.9),
        Vec2::new(0.6, -1.1),
    ])
    .unwrap();
    let (mut one, mut other) = ([0.0; 6], [0.0; 6]);
    for _ in 0..20_000 {
        let at = Vec2::new(rng.between(-2.0, 2.0), rng.between(-2.0, 2.0));
        plane.weights(at, &mut one);
        plane.weights(at + Vec2::new(rng.between(-1e-3, 1e-3), rng.between(-1e-3, 1e-3)), &mut other);
        let most = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(most < 5e-3, "{at}: {one:?} {other:?}");
    }
}

#[test]
fn invalid_planes_are_refused() {
    let [a, b, c] = [Vec2::ZERO, Vec2::new(1.0, 2.0), Vec2::new(2.0, 4.0)];
    assert_eq!(BlendPlane::new([]), Err(SpaceError::Empty));
    assert_eq!(BlendPlane::new([a, b]), Err(SpaceError::Flat));
    assert_eq!(BlendPlane::new([a, b, c]), Err(SpaceError::Flat));
    assert_eq!(BlendPlane::new([a, b, a]), Err(SpaceError::Order(2)));
    assert_eq!(BlendPlane::new([a, b, Vec2::new(f32::NAN, 0.0)]), Err(SpaceError::Place(2)));
    assert_eq!(BlendPlane::new([a, Vec2::new(0.0, 1e30), b]), Err(SpaceError::Place(1)));
    let plane = BlendPlane::new([a, b, c, Vec2::X]).unwrap();
    let mut weights = [0.0; 4];
    plane.weights(Vec2::new(f32::NAN, f32::NEG_INFINITY), &mut weights);
    assert_eq!(weights, [1.0, 0.0, 0.0, 0.0], "of all far below the middle");
}
