//! One line for each thing that a program of the family can say, and what the result says then.

use super::*;

/// Converts a scene of the parts given, checks that it compiles, and looks for what is expected, white space aside.
fn assert_said(scene: &str, expected: &str) {
    let conversion = convert_plainly(scene);
    assert_accounted(scene, &conversion, scene);
    let snell = conversion.only();
    assert_compiles(&snell, scene);
    let squeezed = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let one_line = squeezed(&snell).replace("{ ", "{").replace(" }", "}").replace(", ", " ");
    let wanted = squeezed(expected).replace("{ ", "{").replace(" }", "}").replace(", ", " ");
    assert!(one_line.contains(&wanted), "no `{expected}` of\n{scene}\nin\n{snell}");
}

/// A camera of the Tsinghua family.
const CAMERA: &str = "PerspectiveCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 angle 45 width 8 height 8 }";

#[test]
fn lenses() {
    let disc = |half_side: f64| write_rounded(half_side * std::f64::consts::FRAC_2_SQRT_PI);
    let rows = [
        ("PerspectiveCamera", "focalLength 7 aperture 2", disc(2.0), "7"),
        ("DepthCamera", "focalLength 7 aperture 2", "1".into(), "8"),
        ("PerspectiveCamera", "focus 7 aperture 2", disc(2.0), "7"),
        ("PerspectiveCamera", "aperture 2 focus 7", "1".into(), "7"),
        ("PerspectiveCamera", "aperture 2 focusDistance 7", "1".into(), "7"),
        ("DofCamera", "distance 7 radius 2", "2".into(), "7"),
        ("LensCamera", "dist 7 radius 2", "2".into(), "7"),
        ("LensCamera", "gamma 2.2 aperture 2 focal 7", "2".into(), "7"),
        ("PerspectiveCamera", "lens_radius 2 focus_distance 7", "2".into(), "7"),
        ("PerspectiveCamera", "defocusAngle 90 focusDist 7", "7".into(), "7"),
        ("PerspectiveCamera", "isDOF 1 lenRadius 2 lenSampleNum 9 focusDist 7", "2".into(), "7"),
        ("PerspectiveCamera", "distance 3 aperture 100", disc(0.5), "9"),
        ("PerspectiveCamera", "focusPoint True 0 0 2", "0.3".into(), "7"),
        ("PerspectiveCamera", "focal_length 7 aperture_size 2", disc(1.0), "7"),
        ("PerspectiveCamera", "focus 7 field 2", "2".into(), "7"),
        ("PerspectiveCamera", "aperture 100", disc(0.5), "9"),
        ("PerspectiveCamera", "len_radius 2 focus 7", "2".into(), "7"),
    ];
    for (camera, lens, radius, focus) in rows {
        let scene = CAMERA.replace("PerspectiveCamera", camera).replace(" }", &format!(" {lens} }}"));
        assert_said(&scene, &format!("lens: thin {{ radius: {radius}, focus: {focus} }}"));
    }
    for pinhole in ["isDOF 0 lenRadius 2 focusDist 7", "focusPoint False", "focus 7 radius 2", "aperture 0"] {
        let scene = CAMERA.replace(" }", &format!(" {pinhole} }}"));
        assert!(!convert_plainly(&scene).only().contains("lens:"), "{pinhole}");
    }
}

fn write_rounded(x: f64) -> String {
    (x as f32).to_string()
}

#[test]
fn materials() {
    let rows = [
        // Weights.
        ("Material { type 1 0 0 color 1 0 0 }", "diffuse { color: rgb(1, 0, 0) }"),
        ("Material { type 0 1 0 diffuseColor 0.9 0.9 0.9 }", "mirror { color: 0.9 }"),
        ("Material { type 0 0 1 color 1 1 1 refr 1.4 }", "glass { ior: 1.4, tint: 1 }"),
        (
            "Material { type 1 1 0 color 1 1 1 }",
            "mix { a: diffuse { color: 1 } b: mirror { color: 1 } amount: 0.5 }",
        ),
        ("Material { color 0 0 0 emission 9 9 9 type 1 0 0 }", "emissive { radiance: 9 }"),
        ("Material { type 0.15 0.85 0 color 1 1 1 alpha 0.25 }", "metal { color: 1, roughness: 0.5 }"),
        // Words and integers.
        ("Material { type SPEC color 1 1 1 }", "mirror { color: 1 }"),
        ("Material { type REFL reflectRate 1.3 }", "glass { ior: 1.3, tint: 1 }"),
        ("Material { type 2 refractive_rate 1.7 }", "glass { ior: 1.7, tint: 1 }"),
        (
            "Material { diffuseColor 0.5 0.5 0.5 type METAL roughness 0.25 }",
            "metal { color: 0.5, roughness: 0.5 }",
        ),
        ("Material { surfaceType 2 refractiveIndex 2 diffuseColor 1 1 1 }", "glass { ior: 2, tint: 1 }"),
        // Bare words and names.
        ("Material { Color 0.9 0.5 0.25 SPEC }", "mirror { color: rgb(0.9, 0.5, 0.25) }"),
        ("Material { dielectric eta 1.6 diffuseColor 1 1 1 }", "glass { ior: 1.6, tint: 1 }"),
        ("Material { color 1 1 1 prop Glass }", "glass { ior: 1.65, tint: 1 }"),
        ("Material { color 1 1 1 prop China }", "amount: 0.2 }"),
        // Shares of lobes.
        ("Material { color 1 0 0 diff 1 refr 0 refl 0 }", "diffuse { color: rgb(1, 0, 0) }"),
        ("Material { color 1 1 1 diff 0 refr 1 refl 0 n 1.4 }", "glass { ior: 1.4, tint: 1 }"),
        ("Material { diff_factor 0 spec_factor 1 refr_factor 0 }", "mirror { color: 1 }"),
        (
            "Material { w_diffusion 0 w_reflection 0 w_transmission 1 ref_index 1.8 }",
            "glass { ior: 1.8, tint: 1 }",
        ),
        (
            "Material { diffuseRate 0 specularRate 0 refractRate 1 refractIndex 1.9 }",
            "glass { ior: 1.9, tint: 1 }",
        ),
        (
            "Material { perDiffuse 0 perReflect 0 perRefract 1 refractRate 1.2 }",
            "glass { ior: 1.2, tint: 1 }",
        ),
        ("Material { diffidx 0 reflidx 1 refridx 0 mColor 0 1 0 }", "mirror { color: rgb(0, 1, 0) }"),
        ("Material { reflection 0.0 refraction 1.0 refraction_rate 1.1 }", "glass { ior: 1.1, tint: 1 }"),
        ("Material { diffuseColor 1 1 1 reflective 0.7 }", "amount: 0.7 }"),
        (
            "Material { diffuseColor 1 1 1 transmissive 0.9 1.5 }",
            "b: glass { ior: 1.5, tint: 1 } amount: 0.9 }",
        ),
        // Blocks whose name is their kind.
        ("ReflectiveMaterial { attenuationColor 0.8 0.8 0.9 }", "mirror { color: rgb(0.8, 0.8, 0.9) }"),
        ("RefractiveMaterial { refractive_index 1.4 transmittance 1 1 1 }", "glass { ior: 1.4, tint: 1 }"),
        ("EmissiveMaterial { emissionColor 3 3 3 }", "emissive { radiance: 3 }"),
        ("LightMaterial { specularColor 4 4 4 }", "emissive { radiance: 4 }"),
        (
            "MetalMaterial { attenuation 0.9 0.6 0.2 fuzz 0.25 }",
            "metal { color: rgb(0.9, 0.6, 0.2), roughness: 0.5 }",
        ),
        (
            "RoughDielectric { albedo 1 1 1 eta 1.33 roughness 0.25 }",
            "glass { ior: 1.33, tint: 1, roughness: 0.5 }",
        ),
        ("DielecMaterial { attenuation 1 1 1 refractive 1.5 }", "glass { ior: 1.5, tint: 1 }"),
        ("Metalic { albedo 1 1 1 roughness 0.25 }", "metal { color: 1, roughness: 0.5 }"),
        ("SpecularTransmission { albedo 1 1 1 eta 1.33 }", "glass { ior: 1.33, tint: 1 }"),
        ("Lambert { diffuseColor 0.2 0.2 0.2 }", "diffuse { color: 0.2 }"),
        (
            "GlossyMaterial { diffuseColor 0.5 0.5 0.5 specularColor 0.2 0.2 0.2 roughness 0.5 }",
            "phong { diffuse: 0.5",
        ),
        (
            "UberMaterial { baseColor 0.5 0.5 0.5 metallic 1 roughness 0.25 }",
            "metal { color: 0.5, roughness: 0.5 }",
        ),
        // Flags, and colours beside shares.
        (
            "Material { diffuseColor 0.2 0.2 0.2 specularColor 0.9 0.8 0.7 specular }",
            "mirror { color: rgb(0.9, 0.8, 0.7) }",
        ),
        ("Material { specular specularColor 1 1 1 eta 1.5 }", "glass { ior: 1.5, tint: 1 }"),
        (
            "Material { diffuseColor 0.6 0.6 0.6 specularColor 1 1 1 transparent iota 1.2 }",
            "glass { ior: 1.2, tint: 0.6 }",
        ),
        ("Material { diffuse 0 specularColor 1 1 1 specular 1 diffuseColor 0 0 0 }", "mirror { color: 1 }"),
        (
            "Material { diffuseColor 0 0 0 diffuse 0 specularColor 1 1 1 specular 0.2 refractColor 1 0.5 0.5 refract 0.8 \
             refractiveIndex 1.6 }",
            "mix { a: mirror { color: 1 } b: glass { ior: 1.6, tint: rgb(1, 0.5, 0.5) } amount: 0.8 }",
        ),
        (
            "Material { diffuseColor 1 1 1 reflectiveColor 0.5 0.25 0 reflectance 0.25 transparency 0.25 }",
            "mirror { color: rgb(0.5, 0.25, 0) }",
        ),
        ("Material { diffuseColor 1 0.9 0.8 eta 1.3 }", "glass { ior: 1.3, tint: rgb(1, 0.9, 0.8) }"),
        (
            "Material { diffuseColor 1 1 1 roughness 0.5 ks 0.5 kd 0.25 F0 0.8 0.4 0.2 }",
            "phong { diffuse: 0.25, specular: rgb(0.4, 0.2, 0.1)",
        ),
        (
            "Material { diffuseColor 1 1 1 Fresnel { fbase 0.25 fscale 0.75 power 1 } }",
            "mix { a: diffuse { color: 1 } b: mirror { color: 1 } amount: 0.5 }",
        ),
        (
            "Material { diffuseColor 1 1 1 refractiveIndex 1.4 Fresnel { fbase 0.04 fscale 0.96 power 5 } }",
            "glass { ior: 1.4, tint: 1 }",
        ),
        // Implied by the colours that are there.
        ("Material { lightColor 7 7 7 }", "emissive { radiance: 7 }"),
        ("Material { refractionIndex 1.5 specularColor 1 1 1 }", "glass { ior: 1.5, tint: 1 }"),
        // Of arsenal.txt.
        ("Material { color 1 1 1 reflection 2 }", "glass { ior: 1.5, tint: 1 }"),
        (
            "Material { color 0.5 0.5 0.5 shininess 6 reflection 0 }",
            "phong { diffuse: 0.5, specular: 0.15, shininess: 6 }",
        ),
        // Pictures.
        ("Material { diffuseColor 1 1 1 texture tex/wood.png }", "missing: skip"),
        ("Material { diffuseColor 0.3 0.3 0.3 texture tex/wood.gif }", "diffuse { color: 0.3 }"),
        ("Material { diffuseColor 0.3 0.3 0.3 texture tex/wood.bmp }", "\"tex/wood.bmp\""),
        ("Material { diffuseColor 0.3 0.3 0.3 texture tex/wood.TGA }", "\"tex/wood.TGA\""),
        ("Diffuse { albedoTexture tex/marble.jpg normalMap tex/marble_n.jpg }", "\"tex/marble.jpg\""),
        ("Material { diffuseColor 0.3 0.3 0.3 bump tex/waves.png }", "diffuse { color: 0.3 }"),
    ];
    for (material, expected) in rows {
        let scene = format!(
            "{CAMERA} Materials {{ numMaterials 1 {material} }} \
             Group {{ numObjects 1 MaterialIndex 0 Sphere {{ center 0 0 0 radius 1 }} }}"
        );
        assert_said(&scene, expected);
    }
}

#[test]
fn lights() {
    let rect = |origin: &str, u: &str, v: &str| {
        format!("light rect {{ origin: {origin} edge_u: {u} edge_v: {v} radiance: 2 two_sided: true }}")
    };
    let rows = [
        (
            "AreaLight { position 0 5 0 dir1 2 0 0 dir2 0 0 2 color 2 2 2 }",
            rect("(0, 5, 0)", "(2, 0, 0)", "(0, 0, 2)"),
        ),
        (
            "AreaLight { position 0 5 0 dirX 1 0 0 dirY 0 0 1 color 2 2 2 }",
            rect("(-1, 5, -1)", "(2, 0, 0)", "(0, 0, 2)"),
        ),
        (
            "AreaLight { position 0 5 0 x_axis 1 0 0 y_axis 0 0 1 color 1 1 1 emission 2 }",
            rect("(-1, 5, -1)", "(2, 0, 0)", "(0, 0, 2)"),
        ),
        (
            "AreaLight { position 0 5 0 uvec 2 0 0 vvec 0 0 2 color 2 2 2 }",
            rect("(0, 5, 0)", "(2, 0, 0)", "(0, 0, 2)"),
        ),
        (
            "AreaLight { origin 0 5 0 U 1 0 0 V 0 0 1 LU 0.5 LV 0.5 emission 2 2 2 }",
            "edge_u: (1, 0, 0)".into(),
        ),
        ("AreaLight { p1 0 5 0 p2 2 5 0 p3 0 5 2 flux 2 }", rect("(0, 5, 0)", "(2, 0, 0)", "(0, 0, 2)")),
        // Four corners: row by row, and in a ring.
        (
            "QuadLight { A 0 5 0 B 2 5 0 C 0 5 2 D 2 5 2 color 2 2 2 }",
            rect("(0, 5, 0)", "(2, 0, 0)", "(0, 0, 2)"),
        ),
        (
            "QuadLight { p1 0 5 0 p2 2 5 0 p3 2 5 2 p4 0 5 2 color 2 2 2 }",
            rect("(0, 5, 0)", "(2, 0, 0)", "(0, 0, 2)"),
        ),
        (
            "LightTriangle { vertex0 0 5 0 vertex1 2 5 0 vertex2 0 5 2 color 3 3 3 }",
            "triangle { a: (0, 5, 0), b: (2, 5, 0), c: (0, 5, 2), material: emissive { radiance: 3 }".into(),
        ),
        ("AreaLight { position 0 5 0 normal 0 -1 0 area 4 color 2 2 2 }", "light rect".into()),
        (
            "AreaLight { mesh a.obj position 0 5 0 right 1 0 0 up 0 -1 0 size 2 2 color 1 1 1 scale 2 }",
            "radiance: 2".into(),
        ),
        (
            "AreaLight { DoubleSided emitColor 2 2 2 TinyObj { ./lamp.obj } }",
            "material: emissive { radiance: 2 }".into(),
        ),
        (
            "SurfaceLight { position 0 5 0 norm 0 -1 0 x_axis 1 0 0 x_len 2 y_len 2 color 2 2 2 }",
            "light rect".into(),
        ),
        ("RecLight { position 0 5 0 direction 0 -1 0 up 1 0 0 dx 2 dy 2 color 2 2 2 }", "light rect".into()),
        ("RectLight { normal Y- position 5 X -1 1 Z -1 1 color 2 2 2 }", "origin: (-1, 5, -1)".into()),
        (
            "CircleLight { normal Y- position 5 X 0 Z 1 radius 2 color 3 3 3 }",
            "disk { center: (0, 5, 1) normal: (0, -1, 0) radius: 2".into(),
        ),
        (
            "CircleLight { position 0 5 0 radius 2 normal 0 -1 0 color 3 3 3 }",
            "disk { center: (0, 5, 0) normal: (0, -1, 0) radius: 2".into(),
        ),
        (
            "RoundDisk_Light { position 0 5 0 direction 0 -1 0 radius 2 color 1 1 1 emission 3 3 3 }",
            "emissive { radiance: 3 }".into(),
        ),
        (
            "SphereLight { position 0 5 0 radius 1 color 3 3 3 }",
            "light sphere { center: (0, 5, 0), radius: 1, radiance: 3 }".into(),
        ),
        (
            "SpotLight { position 0 5 0 direction 0 -1 0 maxAngle 30 color 1 1 1 }",
            "light spot { position: (0, 5, 0), direction: (0, -1, 0), angle: 60deg, blend: 0, intensity: 78.54 }"
                .into(),
        ),
        (
            "SpotLight { position 0 5 0 direction 0 -1 0 outerAngle 30 innerAngle 24 color 1 1 1 }",
            "angle: 60deg, blend: 0.2".into(),
        ),
        (
            "SpotLight { position 0 5 0 direction 0 -1 0 falloffAngle 50 hotspotAngle 40 color 1 1 1 }",
            "angle: 50deg, blend: 0.2".into(),
        ),
        ("SpotLight { position 0 5 0 direction 0 -1 0 exponent 2 color 1 1 1 }", "angle: 131.0604deg, blend: 1".into()),
        (
            "PointLight { position 0 1 0 color 1 1 1 brightness 2 }",
            "light point { position: (0, 1, 0), intensity: 6.2832 }".into(),
        ),
        ("DirectionalLight { direction 0 -1 0 color 1 1 1 scale 5 }", "irradiance: 15.708".into()),
    ];
    for (light, expected) in rows {
        assert_said(&format!("{CAMERA} Lights {{ numLights 1 {light} }}"), &expected);
    }
    let disks =
        "DiskLights { numDiskLights 1 DiskLight { position 0 5 0 direction 0 -1 0 radius 2 color 3 3 3 } }";
    assert_said(&format!("{CAMERA} {disks}"), "disk { center: (0, 5, 0)");
}

/// At distance 2, where the middle of the scene is, with `falloff 0.5`.
#[test]
fn point_lights_fall_off_by_the_law_of_their_edition() {
    let intensity = |camera: &str, extra: &str, falloff| {
        let scene = format!(
            "{camera} Lights {{ PointLight {{ position 0 2 0 color 1 1 1 {extra} }} }} \
             Group {{ TriangleMesh {{ obj_file models/a.obj }} }}"
        );
        let options = Options { falloff, ..Options::default() };
        let snell = convert(&scene, "scene.txt", &options, None).only();
        let (_, rest) = snell.split_once("intensity: ").expect("a point light");
        rest.split([' ', '\n']).next().and_then(|number| number.parse::<f64>().ok()).expect("a number")
    };
    let mit = "PerspectiveCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 angle 45 }";
    let close = |found: f64, law: f64| assert!((found - std::f64::consts::PI * law).abs() < 1e-3, "{found}");
    close(intensity(CAMERA, "", Falloff::Auto), 4.0);
    close(intensity(CAMERA, "falloff 0.5", Falloff::Auto), 4.0 / 3.0);
    close(intensity(mit, "falloff 0.5", Falloff::Auto), 1.0 / 0.5);
    close(intensity(mit, "attenuation 1 1 0.25", Falloff::Auto), 4.0 / 4.0);
    close(intensity(mit, "attenuation 0 0 0.25", Falloff::Auto), 1.0 / 0.25);
    close(intensity(mit, "falloff 0.5", Falloff::OnePlus), 4.0 / 3.0);
    close(intensity(mit, "falloff 0.5", Falloff::Constant), 4.0);
    close(intensity(mit, "", Falloff::Auto), 4.0);
}

#[test]
fn shapes() {
    let rows = [
        (
            "Rectangle { point 0 0 0 x 2 0 0 y 0 2 0 }",
            "quad { origin: (0, 0, 0), edge_u: (2, 0, 0), edge_v: (0, 2, 0) }",
        ),
        (
            "Rectangle { position 0 0 0 x_axis 1 0 0 y_axis 0 1 0 }",
            "quad { origin: (-1, -1, 0), edge_u: (2, 0, 0), edge_v: (0, 2, 0) }",
        ),
        (
            "Rectangle { a 0 0 0 b 2 3 0 normal 0 0 1 }",
            "quad { origin: (0, 0, 0), edge_u: (2, 0, 0), edge_v: (0, 3, 0) }",
        ),
        ("XZRectangle { points 0 2 0 3 offset 5 normal 1 }", "quad { origin: (0, 5, 0)"),
        ("Quad { origin 0 0 0 u 2 0 0 v 0 2 0 }", "quad { origin: (0, 0, 0)"),
        ("Square { minPoint 0 0 1 maxPoint 2 2 1 }", "quad { origin: (0, 0, 1)"),
        (
            "Disk { center 0 0 0 normal 0 1 0 radius 2 }",
            "disk { center: (0, 0, 0), normal: (0, 1, 0), radius: 2 }",
        ),
        ("Cube { min_p 1 0 0 max_p 0 1 1 }", "box { min: (0, 0, 0), max: (1, 1, 1) }"),
        ("Torus { R 2 r 0.5 }", "torus { radius: 2, tube: 0.5"),
        (
            "Cylinder { center 1 0 0 radius 2 height 3 }",
            "cylinder { base: (1, 0, 0), top: (1, 3, 0), radius: 2",
        ),
        ("TinyObj { ./mesh/a.obj }", "file: \"./mesh/a.obj\""),
        (
            "TriangleMesh { scale 2 offset 1 0 0 obj_file a.obj }",
            "transform: scale(2) then translate(1, 0, 0)",
        ),
        ("TriangleMesh { obj_file a.obj 2 1 0 0 }", "transform: scale(2) then translate(1, 0, 0)"),
        ("TriangleMesh { obj_file a.obj 3 }", "transform: scale(3)"),
        ("FFDCage { geometry TriangleMesh { obj_file a.obj } controls { 0 0 0 } }", "group { mesh {"),
        (
            "Cylinder { endpoint 0 -1 0 endpoint 0 1 0 radius 2 }",
            "cylinder { base: (0, -1, 0), top: (0, 1, 0), radius: 2, caps: false",
        ),
        ("TriangleMesh { smooth obj_file a.obj }", "smooth: true"),
        ("TriangleMesh { obj_file a.obj use_BVH true }", "smooth: false"),
        ("TriangleMesh { obj_file a.obj scale 2 offset 0 0 0 Y_inverse }", "scale(2, 2, -2)"),
        ("Sphere { center 0 0 0 radius 1 velocity 2 0 0 }", "sphere { center: (1, 0, 0), radius: 1 }"),
        ("Sphere { center 0 0 0 radius 1 speed 2 0 0 }", "sphere { center: (1, 0, 0), radius: 1 }"),
        (
            "MovingSphere { center0 0 0 0 center1 2 0 0 time0 0 time1 1 radius 1 }",
            "sphere { center: (1, 0, 0), radius: 1 }",
        ),
        (
            "MotionSphere { origCenter 0 0 0 center 2 0 0 radius 1 tStart 0 tEnd 1 }",
            "sphere { center: (1, 0, 0), radius: 1 }",
        ),
        ("SphereMoving { center1 0 0 0 center2 2 0 0 radius 1 }", "sphere { center: (1, 0, 0), radius: 1 }"),
        ("Bubble { center 0 0 0 radius 1 }", "sphere { center: (0, 0, 0), radius: 1 }"),
        ("Cluster { Sphere { center 0 0 0 radius 1 } }", "group { sphere"),
        ("Transform { RotateX 90 Sphere { center 0 0 0 radius 1 } }", "rotate_x(90deg)"),
        ("Transform { Scale { 5 1 1 } Sphere { center 0 0 0 radius 1 } }", "scale(5, 1, 1)"),
        (
            "RevSurface { profile BsplineCurve { controls [ -1 0 0 ] [ -1 1 0 ] [ -2 2 0 ] [ -1 3 0 ] } }",
            "bspline [(1, 0), (1, 1), (2, 2), (1, 3)]",
        ),
        (
            "RevSurface { profile BezierCurve { controls [ -1 0 0 ] [ 1 1 0 ] [ 2 2 0 ] [ 1 3 0 ] } }",
            "polyline [",
        ),
        ("Plane { normal 0 1 0 offset 1 texture tex/wood.png }", "image"),
    ];
    for (shape, expected) in rows {
        let plain = expected.strip_suffix(" }").unwrap_or(expected);
        let scene = format!(
            "{CAMERA} Materials {{ Material {{ diffuseColor 1 0 0 }} }} Group {{ MaterialIndex 0 {shape} }}"
        );
        assert_said(&scene, plain);
    }
}

/// Objects outside every group, blocks of settings, lists of pictures, skies.
#[test]
fn odds_and_ends_of_the_top_level() {
    let sphere = "Sphere { center 0 0 0 radius 1 }";
    assert_said(&format!("{CAMERA} Group {{ }} }} {sphere}"), "sphere { center: (0, 0, 0)");
    assert_said(&format!("{CAMERA} Objects {{ numObjects 1 {sphere} }}"), "sphere { center: (0, 0, 0)");
    assert_said(&format!("{CAMERA} Model {{ tracing SPP 64 Monte-Carlo }}"), "stop: samples(64)");
    let listed = "Textures { Image { imgFile tex/earth.png } } Materials { Lambert { texture 0 } }";
    assert_said(&format!("{CAMERA} {listed} Group {{ MaterialIndex 0 {sphere} }}"), "\"tex/earth.png\"");
    assert_said(
        "PerspectiveCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 angle 30 } \
         Background { color 0 0 0 ambientLight 0.1 0.1 0.1 } Lights { PointLight { position 0 1 0 color 1 1 1 } }",
        "environment { radiance: 0.1 }",
    );
    assert_said(
        "OrthographicCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 size 4 }",
        "position: (0, 0, 409) direction: (0, 0, -1) lens: orthographic { height: 4 }",
    );
    assert_said(
        "PerspectiveCamera { position 0 0 9 lookAt 0 0 0 up 0 1 0 fov 30; width 8, height 8 }",
        "fov: 30deg",
    );
}

/// `sin(f x + a N)` has a vein every 2 pi / f, moved by a / 2 pi of that; a transform of the texture by 2 halves both.
#[test]
fn solid_textures_keep_the_lengths_of_their_waves() {
    let rows = [
        (
            "Noise { Transform { UniformScale 2 } {} octaves 3 }",
            "noise { a: 0, b: 1, size: 0.5, octaves: 3 }",
        ),
        (
            "Marble { {} octaves 3 frequency 5 amplitude 2 }",
            "marble { a: 0, b: 1, size: 1.2566371, turbulence: 0.31830987 }",
        ),
        (
            "Wood { {} frequency 10 amplitude 2 }",
            "wood { a: 0, b: 1, size: 0.62831855, turbulence: 0.31830987 }",
        ),
        ("Marble { {} frequency 0 }", "amount: 0.5"),
    ];
    for (solid, expected) in rows {
        let solid = solid.replace("{} ", "materialIndex 0 materialIndex 1 ");
        let camera = "OrthographicCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 size 4 }";
        let plain = "PhongMaterial { diffuseColor 1 0 0 } PhongMaterial { diffuseColor 0 0 1 }";
        let scene = format!(
            "{camera} Materials {{ {plain} {solid} }} Group {{ MaterialIndex 2 Sphere {{ center 0 0 0 radius 1 }} }}"
        );
        assert_said(&scene, expected);
    }
}
