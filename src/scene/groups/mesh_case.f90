!> `&mesh`: number of elements.
module gfb_mesh_case
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type, pad_length
  use gfb_bump_foil_case, only: bump_foil_case_type
  use gfb_case_keys, only: case_keys_type, from_to
  use gfb_model_case, only: model_case_type, meshes_foils
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: mesh_case_type, read_mesh_case

  integer, parameter :: elements_a_pitch = 8    !! resolves the sag between crests to about 5 %
  integer, parameter :: elements_around = 240   !! of a pad without bumps
  integer, parameter, public :: most_a_side = 100000

  !> Number of elements.
  type :: mesh_case_type
    integer :: circumferential_elements = elements_around
    integer :: axial_elements = 32 !! of the whole width, also where one half is solved
    !> width of the elements in the middle over that at the edges of the width [1]
    real(wp) :: edge_refinement = 1.0_wp
    integer :: arc_elements = 12   !! of a bump's arc
    integer :: flat_elements = 3   !! of the flat between two bumps
    !> before the first crest and behind the last one, of a mesh like another one; 0: as many as fit
    integer :: elements_at_ends(2) = 0
    logical :: align_crests = .false. !! lines of nodes of film and top foil lie above the crests
  end type mesh_case_type

contains

  !> Reads the group; its defaults are those of the bearing.
  subroutine read_mesh_case(keys, mesh, bearing, foil, model)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(mesh_case_type), intent(out) :: mesh !! what `&mesh` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    logical :: given, can_align

    call keys%start_group('mesh')
    ! As many nodes, whatever the order of the film's elements.
    mesh%circumferential_elements = default_circumferential_elements(bearing, foil)/model%film_order
    mesh%axial_elements = mesh%axial_elements/model%film_order
    call keys%integer_key('circumferential_elements', mesh%circumferential_elements, &
                          'elements along the pad', from_to(4.0_wp, real(most_a_side, wp)), &
                          default='8 a pitch with bumps, otherwise 240; half of it with '// &
                          '`film_order = 2`', given=given)
    call keys%rule('bump_foil', 'pitch', .not. given .and. &
                   mesh%circumferential_elements > most_a_side, '8 elements a pitch would be '// &
                   'more than '//text(most_a_side)//' along the pad: give circumferential_elements')
    call keys%integer_key('axial_elements', mesh%axial_elements, &
                          'elements of the whole width, also where one half is solved; by '// &
                          'default 16 with `film_order = 2`', &
                          from_to(2.0_wp, real(most_a_side, wp)))
    call keys%real_key('edge_refinement', mesh%edge_refinement, '1', 'width of the elements '// &
                       'in the middle over that at the edges of the width: narrow ones where '// &
                       'the pressure falls; 1: equal ones, as strips side by side '// &
                       'always have', from_to(1.0_wp, 100.0_wp))
    call keys%integer_key('arc_elements', mesh%arc_elements, "elements of a bump's arc", &
                          from_to(2.0_wp, 1000.0_wp))
    call keys%rule('mesh', 'arc_elements', modulo(mesh%arc_elements, 2) /= 0, &
                   'must be even: a node lies on the crest')
    call keys%integer_key('flat_elements', mesh%flat_elements, &
                          'elements of the flat between two bumps', from_to(1.0_wp, 1000.0_wp))
    can_align = meshes_foils(model%foil) .and. foil%bumps > 0 .and. &
                min(foil%pitch%value, foil%half_length%value, foil%height%value) > 0.0_wp
    mesh%align_crests = can_align
    call keys%logical_key('align_crests', mesh%align_crests, &
                          'put lines of nodes of film and top foil above the crests; the '// &
                          'number of elements is then near circumferential_elements', &
                          default='`.true.` for shells and beams with bumps')
    call keys%rule('mesh', 'align_crests', mesh%align_crests .and. .not. can_align .and. &
                   model%foil > 0, "needs foil = 'shell', and bumps, pitch, half_length and "// &
                   "height in &bump_foil; 'beam' will do, too")
  end subroutine read_mesh_case

  !> Elements along the pad where the case does not say: whole pitches that cover it.
  elemental function default_circumferential_elements(bearing, foil) result(elements)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer :: elements
    real(wp), parameter :: rounding = 1.0e-9_wp !! whole pitches are not rounded up, relative
    real(wp) :: pitches

    elements = elements_around
    if (.not. foil%pitch%value > 0.0_wp .or. .not. bearing%radius > 0.0_wp) return
    pitches = pad_length(bearing)/foil%pitch%value*(1.0_wp - rounding)
    elements = elements_a_pitch*ceiling(min(pitches, real(most_a_side, wp)))
  end function default_circumferential_elements
end module gfb_mesh_case
