!> `&top_foil`: the smooth foil under the film.
module gfb_top_foil_case
  use gfb_kinds, only: wp
  use gfb_bearing_row, only: bearing_row_type
  use gfb_case_keys, only: case_keys_type, no_default, between, positive
  use gfb_foil_row, only: foil_row_type
  use gfb_key_effect, only: acts_on_sheets, acts_on_shapes, acts_on_all
  use gfb_scene_case, only: needs_type
  implicit none (type, external)
  private
  public :: top_foil_case_type, read_top_foil_case, initial_curvature

  integer, parameter, public :: top_foil_leading = 1  !! fixed at its leading edge
  integer, parameter, public :: top_foil_trailing = 2 !! fixed at its trailing edge

  character(len=*), parameter :: top_foil_edges(*) = [character(len=8) :: 'leading', 'trailing']

  !> The top foil. A number that is not given is zero.
  type :: top_foil_case_type
    logical :: present = .false.        !! the group stands in the file
    real(wp) :: thickness = 0.0_wp      !! [m]
    real(wp) :: youngs_modulus = 0.0_wp !! [Pa]
    real(wp) :: poissons_ratio = 0.0_wp !! [1]
    real(wp) :: density = 0.0_wp        !! [kg/m^3]
    integer :: fixed_edge = top_foil_trailing
    real(wp) :: free_radius = 0.0_wp    !! of its curvature without forces; 0: it lies as it is [m]
  end type top_foil_case_type

contains

  !> Reads the group.
  subroutine read_top_foil_case(keys, foil, bearing, needs, model)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(top_foil_case_type), intent(out) :: foil !! what `&top_foil` asks for
    type(bearing_row_type), intent(in) :: bearing !! the kind of bearing
    type(needs_type), intent(in) :: needs !! of the analysis
    type(foil_row_type), intent(in) :: model !! of the foils

    call keys%start_group('top_foil', required=needs%top_foil, optional=.true., &
                          present_in_file=foil%present, acts_on=acts_on_all)
    if (keys%line_of_group('thermal') == 0) call say_idle() ! heat flows along any sheet
    call keys%real_key('thickness', foil%thickness, 'm', 'thickness of the foil', positive, &
                       needs%top_foil, default=no_default, acts_on=acts_on_sheets)
    call say_idle()
    call keys%real_key('youngs_modulus', foil%youngs_modulus, 'Pa', "Young's modulus", positive, &
                       needs%top_foil, default=no_default, acts_on=acts_on_sheets)
    call keys%real_key('poissons_ratio', foil%poissons_ratio, '1', "Poisson's ratio", &
                       between(-1.0_wp, 0.5_wp), needs%top_foil, default=no_default, &
                       acts_on=acts_on_sheets)
    call keys%real_key('density', foil%density, 'kg/m^3', 'density', positive, needs%top_mass, &
                       default=no_default)
    if (needs%weightless /= '') call keys%idle(trim(needs%weightless), 'density')
    if (bearing%has_sectors) foil%fixed_edge = top_foil_leading ! where their ramp begins
    call keys%choice_key('fixed_edge', foil%fixed_edge, top_foil_edges, 'where the foil is '// &
                         'fixed; of thrust bearings it is leading by default')
    call keys%real_key('free_radius', foil%free_radius, 'm', 'radius of the foil before it is '// &
                       'put in: larger than `radius` presses it on its bumps, smaller lifts it', &
                       positive, default='`radius`', &
                       useless=trim(bearing%journal_keys), acts_on=acts_on_shapes)

  contains

    !> Foils without a mesh have none of the keys.
    subroutine say_idle()
      if (.not. model%has_top_foil) call keys%idle(model%needs_bumps())
    end subroutine say_idle
  end subroutine read_top_foil_case

  !> Curvature of the foil without forces over that of the bore, \( \kappa_0 = 1/R_f - 1/R \).
  elemental function initial_curvature(foil, radius) result(curvature)
    type(top_foil_case_type), intent(in) :: foil !! what `&top_foil` asks for
    real(wp), intent(in) :: radius !! of the bearing [m]
    real(wp) :: curvature          !! positive: the foil is rolled more closely [1/m]

    curvature = 0.0_wp
    if (foil%free_radius > 0.0_wp) curvature = 1.0_wp/foil%free_radius - 1.0_wp/radius
  end function initial_curvature
end module gfb_top_foil_case
