//! The table of pages. To add one, add a line here and the file `docs/codes/PHASE/NAME.md`.

use super::{Level, Page};

macro_rules! pages {
    ($($phase:ident { $($name:ident: $level:ident,)* })*) => {
        &[$($(Page {
            code: concat!("snell::", stringify!($phase), "::", stringify!($name)),
            level: Level::$level,
            markdown: include_str!(concat!(
                "../../docs/codes/", stringify!($phase), "/", stringify!($name), ".md"
            )),
        },)*)*]
    };
}

/// Every page, by code.
pub fn pages() -> &'static [Page] {
    PAGES
}

const PAGES: &[Page] = pages! {
    allow {
        idle: Warning,
        not_a_warning: Error,
        unknown_code: Error,
    }
    check {
        camera_in_glass: Warning,
        camera_looks_nowhere: Error,
        camera_sealed: Warning,
        caustics_by_luck: Warning,
        caustics_invisible: Warning,
        coincident_glass: Warning,
        creates_energy: Error,
        crossing_outline: Warning,
        curve_points: Error,
        dark_light: Warning,
        degenerate: Error,
        endless_light: Error,
        film_size: Error,
        focus_behind: Error,
        focus_not_once: Error,
        focus_too_near: Error,
        glass_overlap: Warning,
        hole_outside: Error,
        inside_out_box: Error,
        inside_out_glass: Warning,
        ior_below_one: Error,
        light_against_wall: Warning,
        light_faces_away: Warning,
        light_hidden: Warning,
        light_sealed: Warning,
        loose_error: Warning,
        negative_light: Error,
        negative_radius: Error,
        no_camera: Error,
        no_light: Warning,
        not_positive: Error,
        nothing_in_view: Warning,
        object_hidden: Warning,
        open_glass: Warning,
        out_of_range: Error,
        phong_energy: Warning,
        short_paths: Warning,
        singular_transform: Error,
        squeezing_transform: Warning,
        too_deep_mix: Error,
        too_large: Error,
        too_many_parts: Error,
        too_small_to_see: Warning,
        unknown_camera: Error,
        up_along_view: Error,
    }
    load {
        bad_mesh: Error,
        bad_picture: Error,
        mesh_note: Warning,
        missing_file: Error,
        outside: Error,
        skipped_file: Warning,
        unreadable: Error,
    }
    lower {
        bad_focus: Error,
    }
    plan {
        classic_only: Error,
        endless_photons: Warning,
        photons_without_receiver: Warning,
    }
    resolve {
        argument_count: Error,
        black_glass: Warning,
        budget: Error,
        conflicting_fields: Error,
        cycle: Error,
        duplicate_argument: Error,
        duplicate_field: Error,
        duplicate_name: Error,
        incompatible: Error,
        misplaced: Error,
        missing_argument: Error,
        missing_field: Error,
        missing_unit: Error,
        no_csg: Error,
        no_value: Error,
        not_finite: Error,
        not_yet: Error,
        out_of_bounds: Error,
        out_of_range: Error,
        recursion: Error,
        second_block: Error,
        several_values: Error,
        shadowed: Warning,
        uneven_light: Error,
        unknown_argument: Error,
        unknown_block: Error,
        unknown_field: Error,
        unknown_material: Error,
        unknown_member: Error,
        unknown_name: Error,
        unknown_parameter: Error,
        unknown_type: Error,
        unknown_unit: Error,
        unknown_word: Error,
        unused: Warning,
        wrong_dimension: Error,
        wrong_type: Error,
    }
    syntax {
        apart_unit: Error,
        bad_allow: Error,
        bad_color: Error,
        bad_data: Error,
        extra_comma: Error,
        file_cycle: Error,
        file_not_found: Error,
        file_outside: Error,
        file_too_large: Error,
        file_unreadable: Error,
        foreign: Error,
        huge_number: Error,
        include_depth: Error,
        mismatched_bracket: Error,
        misplaced_version: Error,
        missing_block: Error,
        missing_comma: Error,
        missing_name: Error,
        missing_operand: Error,
        missing_sign: Error,
        missing_type: Error,
        missing_value: Error,
        missing_version: Error,
        not_utf8: Error,
        reserved_word: Error,
        semicolon: Error,
        sign_at_line_start: Error,
        stray_bracket: Error,
        stray_comment_end: Error,
        stray_field: Error,
        too_deep: Error,
        typed_let: Error,
        unclosed_bracket: Error,
        unclosed_comment: Error,
        unclosed_quote: Error,
        unknown_character: Error,
        unknown_item: Error,
        unreadable: Error,
        unsupported_version: Error,
        wrong_quotes: Error,
        wrong_sign: Error,
    }
};
