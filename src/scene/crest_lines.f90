!> The crests of bumps under a plate: lines of springs, where they lie and how stiff they are.
!>
!> On a journal's pad strips lie as strips of shells do, from their fixed edge on. On a sector they
!> begin where its ramp ends, at a pitch measured at the mean radius of the strip; crests are
!> rays, and chord and pitch of their bumps grow with the radius. So Walowit and Anno's line has
!>
!> $$ k(r) = \frac{E t^3}{2 (1 - \nu^2) l^3} \left(\frac{r}{r_m}\right)^{-3} $$
!>
!> with l half the chord at the mean radius. Source: [WalowitAnno1975], times the pitch.
module gfb_crest_lines
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type, surface_of, pad_angle, strip_ends
  use gfb_film_surface, only: film_surface_type
  use gfb_foil_cases, only: bump_foil_case_type, one_strip, fixed_edge_trailing
  use gfb_scene, only: scene_type
  use gfb_strip_load_case, only: bump_stiffness
  implicit none (type, external)
  private
  public :: crest_lines, plate_sides

  real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative
  !> of the radius in the stiffness of a line under a sector
  real(wp), parameter :: curved_strip_exponent = -3.0_wp

  !> A line of springs.
  type, public :: crest_line_type
    integer :: number = 0             !! of the crest, from the leading edge on
    integer :: strip = 1              !! that it belongs to
    real(wp) :: angle = 0.0_wp        !! from the leading edge [rad]
    real(wp) :: ends(2) = 0.0_wp      !! along the rows: z, or the radius [m]
    real(wp) :: stiffness = 0.0_wp    !! line force over deflection, at the mean radius [N/m^2]
    real(wp) :: mean_radius = 0.0_wp  !! of a sector's strip [m]
    real(wp) :: exponent = 0.0_wp     !! of the radius, with which the stiffness changes [1]
  end type crest_line_type

contains

  !> All lines under a pad, strip by strip.
  pure function crest_lines(scene) result(lines)
    type(scene_type), intent(in) :: scene !! with a plate
    type(crest_line_type), allocatable :: lines(:)
    type(crest_line_type) :: one
    type(bump_foil_case_type) :: foil
    real(wp), allocatable :: angle(:)
    type(film_surface_type) :: surface
    integer :: strip, i

    allocate (lines(0))
    surface = surface_of(scene%bearing)
    associate (bearing => scene%bearing)
      do strip = 1, scene%bump_foil%strips
        foil = one_strip(scene%bump_foil, strip)
        one%strip = strip
        one%ends = strip_ends(bearing, scene%bump_foil%strips, scene%bump_foil%cut_width, strip)
        one%mean_radius = surface%radius_at(0.5_wp*sum(one%ends))
        one%stiffness = scene%model%crest_stiffness
        one%exponent = 0.0_wp
        if (.not. one%stiffness > 0.0_wp) then
          one%stiffness = bump_stiffness(foil)*foil%pitch%value
          if (bearing%row%has_sectors) one%exponent = curved_strip_exponent
        end if
        angle = crests_on_pad(bearing, foil, one%mean_radius)
        do i = 1, size(angle)
          one%number = i
          one%angle = angle(i)
          lines = [lines, one]
        end do
      end do
    end associate
  end function crest_lines

  !> Where crests of a strip stand, from the leading edge on [rad].
  pure function crests_on_pad(bearing, foil, radius) result(angle)
    type(bearing_case_type), intent(in) :: bearing
    type(bump_foil_case_type), intent(in) :: foil !! of one strip
    real(wp), intent(in) :: radius !! at which its pitch is measured [m]
    real(wp), allocatable :: angle(:)
    real(wp) :: first, arc
    integer :: bumps, i

    angle = foil%crest_angles
    if (size(angle) > 0) return
    if (.not. min(foil%pitch%value, radius) > 0.0_wp) return
    arc = pad_angle(bearing)
    first = foil%offset%value + foil%half_length%value
    if (.not. foil%half_length%value > 0.0_wp) first = foil%offset%value + 0.5_wp*foil%pitch%value
    first = first + bearing%ramp_part*arc*radius
    bumps = foil%bumps
    if (bumps == 0) then
      associate (room => arc*radius - first - foil%half_length%value)
        if (room < 0.0_wp) return
        bumps = 1 + int(room/foil%pitch%value*(1.0_wp + rounding))
      end associate
    end if
    angle = [((first + real(i, wp)*foil%pitch%value)/radius, i=0, bumps - 1)]
    if (bearing%row%has_sectors .or. foil%fixed_edge /= fixed_edge_trailing) return
    angle = arc - angle(bumps:1:-1)
  end function crests_on_pad

  !> Where sides of elements lie under a plate, from its leading edge: at all strips' crests, and at
  !> kinks of the gap [rad].
  pure function plate_sides(scene, kink) result(angle)
    type(scene_type), intent(in) :: scene !! with a plate
    real(wp), intent(in) :: kink(:) !! of the gap [rad]
    real(wp), allocatable :: angle(:)
    type(crest_line_type), allocatable :: lines(:)
    real(wp), allocatable :: all_angles(:)
    real(wp) :: last

    lines = crest_lines(scene)
    all_angles = [lines%angle, kink]
    allocate (angle(0))
    last = 0.0_wp
    do while (any(all_angles > last*(1.0_wp + rounding)))
      last = minval(all_angles, all_angles > last*(1.0_wp + rounding))
      angle = [angle, last]
    end do
  end function plate_sides
end module gfb_crest_lines
