//! What the result says is what the original says.

use super::*;

#[test]
fn every_dialect_is_told_by_what_sets_it_apart() {
    let thu = "PerspectiveCamera { width 4 height 4 } ";
    let material = |fields: &str| format!("{thu} Materials {{ Material {{ color 1 1 1 }} {fields} }}");
    let cases = [
        (material("Material { reflection 2 }"), Dialect::Arsenal),
        (material("Material { emissionColor 12 12 12 }"), Dialect::Arsenal),
        (format!("{thu} Group {{ TriangleMesh {{ Y_inverse }} }}"), Dialect::Arsenal),
        (material("PhongMaterial { diffuseColor 1 0 0 shininess 20}"), Dialect::Pa1),
        (thu.to_string(), Dialect::Pa1),
        (material("Material { type 1 0 0 }"), Dialect::Weights),
        (material("Material { type 0 1 0 0 refr 1.5 }"), Dialect::Weights),
        (material("Material { type SPEC }"), Dialect::Enum),
        (material("Material { type 2 refr 1.5 }"), Dialect::Enum),
        (material("Material { SPEC }"), Dialect::Flags),
        (material("Material { prop Glass }"), Dialect::Flags),
        (material("ReflectiveMaterial { }"), Dialect::Typed),
        (material("Material { diff 1.0 refl 0 refr 0 }"), Dialect::Factors),
        (material("Material { reflection 0.5 refraction_rate 1.5 }"), Dialect::Factors),
        ("Group { Material { diffuseColor 1 0 0 } }".into(), Dialect::Mit2003),
        ("OrthographicCamera { size 5 }".into(), Dialect::Mit2004),
        ("PerspectiveCamera { } Materials { Marble { } }".into(), Dialect::Mit2004),
        ("PerspectiveCamera { } Lights { PointLight { attenuation 0 0 1 } }".into(), Dialect::Mit2004),
        ("PerspectiveCamera { } Materials { Material { refractionIndex 2 } }".into(), Dialect::Mit2010),
        ("PerspectiveCamera { } Group { TriangleMesh { obj_file models/a.obj } }".into(), Dialect::Mit2016),
    ];
    for (text, expected) in cases {
        assert_eq!(convert_plainly(&text).scenes[0].detection.dialect, expected, "{text}");
    }
    for dialect in Dialect::ALL {
        assert_eq!(Dialect::from_id(dialect.id()), Some(dialect));
        let forced = Options { dialect: Some(dialect), ..Options::default() };
        assert_eq!(convert(thu, "scene.txt", &forced, None).scenes[0].detection.dialect, dialect);
    }
}

/// The value after a name in the result, up to the end of its line.
fn value_of<'t>(snell: &'t str, name: &str) -> &'t str {
    let start = snell.find(name).unwrap_or_else(|| panic!("no `{name}` in\n{snell}")) + name.len();
    snell[start..].lines().next().unwrap_or_default().trim()
}

/// All numbers in a stretch of text.
fn numbers_in(text: &str) -> Vec<f64> {
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '-' | '.');
    text.split(|c| !is_part(c)).filter_map(|number| number.parse().ok()).collect()
}

const CAMERA: &str = "PerspectiveCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 angle 45 width 8 height 8 }";

#[test]
fn transforms_act_in_the_order_of_the_original() {
    let text = format!(
        "{CAMERA} Materials {{ Material {{ diffuseColor 1 1 1 }} }} Group {{ MaterialIndex 0 Transform {{ \
         Scale 8 8 8 Translate 0.5 0 0 Transform {{ ZRotate 90 Sphere {{ center 1 0 0 radius 1 }} }} }} }}"
    );
    let snell = convert_plainly(&text).only();
    let chain = value_of(&snell, "transform: ");
    assert!(chain.starts_with("rotate_z(90deg) then translate(0.5, 0, 0) then scale(8)"), "{chain}");
}

#[test]
fn matrices_multiply_from_the_left_and_lie_as_they_are_named() {
    let text = |name: &str, numbers: &str| {
        format!(
            "{CAMERA} Materials {{ Material {{ diffuseColor 1 1 1 }} }} Group {{ MaterialIndex 0 Transform {{ \
             XRotate 5 {name} {{ {numbers} }} YRotate 6 Sphere {{ center 0 0 0 radius 1 }} }} }}"
        )
    };
    let rows = convert_plainly(&text("Matrix", "1 2 3 4 5 6 7 8 9 10 12 12 0 0 0 1")).only();
    assert!(rows.contains("rotate_y(6deg)") && rows.contains("rotate_x(5deg)"));
    let order = ["rotate_y", "rotate_x", "matrix"].map(|name| rows.find(name).expect("a step"));
    assert!(order.is_sorted(), "{rows}");
    assert!(rows.contains("matrix([1, 2, 3, 4, 5"), "{rows}");
    let columns = convert_plainly(&text("Matrix4f", "1 5 9 0 2 6 10 0 3 7 12 0 4 8 12 1")).only();
    assert!(columns.contains("matrix([1, 2, 3, 4, 5"), "{columns}");
}

/// A picture on a plane: the converted projection must name the pixel that the original names.
#[test]
fn a_picture_lies_where_the_original_puts_it() {
    let (x, y, xo, yo) = ([2.0, 0.0, 1.0], [0.5, 3.0, 0.0], -6.0, 2.5);
    let text = format!(
        "{CAMERA} Materials {{ Material {{ color 1 1 1 }} }} Group {{ MaterialIndex 0 Plane {{ normal 0 0 1 offset -3 \
         texture wall.ppm x-axis 2 0 1 y-axis 0.5 3 0 x-offset {xo} y-offset {yo} }} }}"
    );
    let snell = convert_plainly(&text).only();
    let start = snell.find("planar {").expect("a projection");
    let frame = numbers_in(snell[start..].split('}').next().unwrap_or_default());
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (origin, u, v) = (&frame[0..3], &frame[3..6], &frame[6..9]);
    for p in [[0.0, 0.0, -3.0], [1.5, -2.0, -3.0], [-4.0, 7.0, 0.25]] {
        let from_origin = [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]];
        let pixel = |axis: &[f64], side: f64| side * dot(&from_origin, axis) / dot(axis, axis);
        assert!((pixel(u, 8.0) - (dot(&x, &p) - xo)).abs() < 1e-5, "{snell}");
        assert!((pixel(v, 4.0) - (dot(&y, &p) - yo)).abs() < 1e-5, "{snell}");
    }
}

/// With the basis of 2020, a point at the picture's upper edge has `s tan(angle / 2)` for the tangent of its height.
#[test]
fn a_leaning_up_changes_the_angle_in_the_dialect_of_arsenal_only() {
    let camera = "PerspectiveCamera { center 0 0 0 direction 0 -3 -4 up 0 1 0 angle 60 width 8 height 8 }";
    let fov = |basis| {
        let options = Options { basis, ..Options::default() };
        let snell = convert(camera, "scene.txt", &options, None).only();
        numbers_in(value_of(&snell, "fov: "))[0]
    };
    assert_eq!(fov(None), 60.0);
    assert_eq!(fov(Some(Basis::Orthonormal)), 60.0);
    let tangent = crate::math::float::tan64((fov(Some(Basis::Raw)) / 2.0).to_radians());
    let expected = 0.8 / 3.0_f64.sqrt(); // s = |(0, -0.6, -0.8) x (0, 1, 0)| = 0.8
    assert!((tangent - expected).abs() < 1e-6, "{tangent} instead of {expected}");
}

/// The course shows `c diffuse cos` and a highlight of `c specular`; a converted surface must shine as brightly.
#[test]
fn the_course_s_brightness_is_kept_at_the_middle_of_the_scene() {
    let text = format!(
        "{CAMERA} Lights {{ PointLight {{ position 0 0 5 color 0.5 0.5 0.5 }} }} Materials {{ Material {{ \
         diffuseColor 0.3 0.3 0.3 specularColor 0.8 0.8 0.8 shininess 14 }} }} \
         Group {{ MaterialIndex 0 Sphere {{ center 0 0 2 radius 1 }} }}"
    );
    let snell = convert_plainly(&text).only();
    let after = |name| numbers_in(value_of(&snell, name))[0];
    let irradiance = after("intensity: ") / (3.0 * 3.0);
    let pi = std::f64::consts::PI;
    assert!((irradiance * after("diffuse: ") / pi - 0.5 * 0.3).abs() < 1e-4, "{snell}");
    // The lobe at its middle: specular (n + 2) / (2 pi).
    let highlight = irradiance * after("specular: ") * (14.0 + 2.0) / (2.0 * pi);
    assert!((highlight - 0.5 * 0.8).abs() < 1e-4, "{snell}");
}

#[test]
fn lights_are_kept_where_programs_use_them() {
    let lights = "Lights { PointLight { position 0 1 0 color 1 1 1 } }";
    let lamp = "Materials { Material { color 0 0 0 emission 9 9 9 type 1 0 0 } }";
    let has_light = |text: &str, lights| {
        let options = Options { lights, ..Options::default() };
        convert(text, "scene.txt", &options, None).only().contains("light point")
    };
    let course = format!("{CAMERA} {lights}");
    let weights = format!("{CAMERA} {lights} {lamp}");
    assert!(has_light(&course, Lights::Auto) && !has_light(&course, Lights::Drop));
    assert!(!has_light(&weights, Lights::Auto) && has_light(&weights, Lights::Keep));
}
