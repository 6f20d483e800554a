!> `&mesh`, the number of elements, and `&solver`, tolerances and limits of the solution.
module gfb_mesh_case
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type, pad_angle, middle_radius
  use gfb_bearing_row, only: bearing_journal, bearing_thrust, needs_journal
  use gfb_case_keys, only: case_keys_type, between, from_to, positive, unless
  use gfb_text, only: text
  use gfb_foil_cases, only: bump_foil_case_type, strip_straight
  use gfb_groove_case, only: groove_case_type, resolved_rows, resolved_refinement
  use gfb_model_case, only: model_case_type
  implicit none (type, external)
  private
  public :: solver_case_type, read_solver_case, mesh_case_type, read_mesh_case

  real(wp), parameter :: touch_down_part = 1.0e-4_wp !! of the clearance, smallest film
  real(wp), parameter :: most_iterations = 1.0e6_wp

  integer, parameter, public :: linear_solver_direct = 1
  integer, parameter, public :: linear_solver_out_of_core = 2 !! direct, with factors in files
  integer, parameter, public :: linear_solver_iterative = 3
  integer, parameter, public :: linear_solver_auto = 4 !! direct or iterative, by the size

  character(len=*), parameter :: linear_words(*) = [character(len=11) :: &
                                                    'direct', 'out_of_core', 'iterative', 'auto']

  !> Of a search from nothing, unless the case bounds it. The dearest answers of
  !> docs/measured/population.md take 1,242 factorizations and 2.6e6 unknowns, with shells 834 and
  !> 3.7e6. A million unknowns take 1 to 24 s.
  integer, parameter :: usual_factorizations = 1500, usual_of_shells = 900
  real(wp), parameter :: usual_work = 4.0e6_wp, usual_work_of_shells = 5.0e6_wp

  !> Tolerances and limits.
  type :: solver_case_type
    real(wp) :: residual_tolerance = 1.0e-10_wp !! of the scaled residual [1]
    real(wp) :: step_tolerance = 1.0e-9_wp      !! of the scaled step [1]
    integer :: maximum_iterations = 40          !! Newton steps of one load step
    integer :: maximum_load_steps = 200
    integer :: maximum_factorizations = 0 !! of a search from nothing; 0: as many as usual
    integer :: most_factorizations = usual_factorizations !! that it may take then
    real(wp) :: most_work = usual_work !! unknowns that it may factor then, each time counted
    real(wp) :: smallest_load_step = 1.0e-4_wp  !! of the whole path [1]
    real(wp) :: touch_down_gap = 0.0_wp         !! below it an equilibrium is refused [m]
    logical :: stability = .false.              !! count the foils' modes that grow
    integer :: linear_solver = linear_solver_auto
    logical :: solver_chosen = .false.          !! by the program, for 'auto'
    logical :: memory_check = .true.            !! refuse what the machine cannot hold
  end type solver_case_type

  integer, parameter :: elements_a_pitch = 8    !! resolves the sag between crests to about 5 %
  integer, parameter, public :: most_a_side = 100000

  !> Number of elements.
  type :: mesh_case_type
    integer :: circumferential_elements = bearing_journal%elements
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

  !> Reads the group; the touch-down gap's default is a part of the clearance.
  subroutine read_solver_case(keys, solver, bearing, touches, shells)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(solver_case_type), intent(out) :: solver !! what `&solver` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    logical, intent(in) :: touches !! solid contact carries the shaft where the film does not
    logical, intent(in) :: shells  !! foils are

    call keys%start_group('solver')
    call keys%real_key('residual_tolerance', solver%residual_tolerance, '1', &
                       'scaled residual at which Newton''s method stops', between(0.0_wp, 1.0_wp))
    call keys%real_key('step_tolerance', solver%step_tolerance, '1', &
                       'scaled step at which Newton''s method stops', between(0.0_wp, 1.0_wp))
    call keys%integer_key('maximum_iterations', solver%maximum_iterations, &
                          'Newton steps of one load step at most', from_to(1.0_wp, most_iterations))
    call keys%integer_key('maximum_load_steps', solver%maximum_load_steps, &
                          'load steps at most', from_to(1.0_wp, most_iterations))
    call keys%integer_key('maximum_factorizations', solver%maximum_factorizations, &
                          'factorizations, of all meshes, after which a search from '// &
                          'nothing gives up', &
                          from_to(0.0_wp, most_iterations), &
                          default='0: when they have factored '//text(usual_work, 2)// &
                          ' unknowns, with shells '//text(usual_work_of_shells, 2)// &
                          ', and after '//text(usual_factorizations)//', with shells '// &
                          text(usual_of_shells))
    if (solver%maximum_factorizations > 0) then
      solver%most_factorizations = solver%maximum_factorizations
      solver%most_work = huge(1.0_wp)
    else if (shells) then
      solver%most_factorizations = usual_of_shells
      solver%most_work = usual_work_of_shells
    end if
    call keys%real_key('smallest_load_step', solver%smallest_load_step, '1', &
                       'smallest load step, over the whole path, before the path is given up', &
                       between(0.0_wp, 1.0_wp))
    if (.not. touches) solver%touch_down_gap = touch_down_part*bearing%clearance
    call keys%real_key('touch_down_gap', solver%touch_down_gap, 'm', &
                       'film thickness below which an equilibrium is refused as touch-down', &
                       positive, &
                       default='1e-4 of the clearance; none with &shaft_contact')
    call keys%rule('solver', 'touch_down_gap', bearing%clearance > 0.0_wp .and. &
                   solver%touch_down_gap >= bearing%clearance, 'must be less than the '// &
                   'clearance, '//text(bearing%clearance)//' m')
    call keys%logical_key('stability', solver%stability, &
                          'count the growing modes of the foils, with the shaft fixed')
    call keys%choice_key('linear_solver', solver%linear_solver, linear_words, &
                         'factors in memory, factors in files, or iterations (shells whose '// &
                         'bumps are not condensed); `auto`: iterations from 500,000 unknowns '// &
                         'of a bearing on, where nothing needs factors')
    call keys%logical_key('memory_check', solver%memory_check, &
                          'refuse a scene that needs more memory than the machine has')
  end subroutine read_solver_case

  !> Reads the group; its defaults are those of the bearing.
  subroutine read_mesh_case(keys, mesh, bearing, foil, model, grooves)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(mesh_case_type), intent(out) :: mesh !! what `&mesh` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(groove_case_type), intent(in) :: grooves !! what `&grooves` asks for
    logical :: given, can_align

    call keys%start_group('mesh')
    ! As many nodes, whatever the order of the film's elements.
    mesh%circumferential_elements = elements_along_pad(bearing, foil, model)/model%film_order
    mesh%axial_elements = mesh%axial_elements/model%film_order
    mesh%edge_refinement = bearing%row%edge_refinement
    if (keys%line_of_group('feed') > 0) mesh%edge_refinement = bearing_thrust%edge_refinement
    if (grooves%are_resolved()) then
      mesh%circumferential_elements = grooves%usual_elements()
      mesh%axial_elements = 2*resolved_rows/model%film_order
      mesh%edge_refinement = resolved_refinement
    end if
    call keys%integer_key('circumferential_elements', mesh%circumferential_elements, &
                          'elements along the pad', from_to(4.0_wp, real(most_a_side, wp)), &
                          default='8 a pitch with bumps, otherwise 240, of a thrust '// &
                          'bearing 64 or more; half of it with '// &
                          '`film_order = 2`; 12 of each groove that is meshed, 192 '// &
                          'at least', given=given)
    call keys%rule('bump_foil', 'pitch', .not. given .and. &
                   mesh%circumferential_elements > most_a_side, '8 elements a pitch would be '// &
                   'more than '//text(most_a_side)//' along the pad: give circumferential_elements')
    call keys%integer_key('axial_elements', mesh%axial_elements, &
                          'elements of the whole width, also where one half is solved; by '// &
                          'default 16 with `film_order = 2`, 40 along grooves that are meshed', &
                          from_to(2.0_wp, real(most_a_side, wp)), &
                          useless=unless(bearing%row%journal_keys == '', needs_journal//': '// &
                                         'radial_elements stands for it'))
    call keys%integer_key('radial_elements', mesh%axial_elements, 'elements from the inner to '// &
                          'the outer radius of a thrust bearing', &
                          from_to(2.0_wp, real(most_a_side, wp)), default='32; 16 with '// &
                          '`film_order = 2`', &
                          useless=trim(bearing%row%thrust_keys))
    call keys%real_key('edge_refinement', mesh%edge_refinement, '1', 'width of the elements '// &
                       'in the middle over that at the edges of the width: narrow ones where '// &
                       'the pressure falls; 1: equal ones, as strips side by side '// &
                       'always have; of thrust bearings along both ways', from_to(1.0_wp, &
                       100.0_wp), default='1; 9 for thrust bearings and with &feed; 20 for '// &
                       'grooves that are meshed, of each ridge, groove and band')
    call keys%integer_key('arc_elements', mesh%arc_elements, "elements of a bump's arc", &
                          from_to(2.0_wp, 1000.0_wp))
    call keys%rule('mesh', 'arc_elements', modulo(mesh%arc_elements, 2) /= 0, &
                   'must be even: a node lies on the crest')
    call keys%integer_key('flat_elements', mesh%flat_elements, &
                          'elements of the flat between two bumps', from_to(1.0_wp, 1000.0_wp))
    can_align = model%foil%has_bumps .and. foil%bumps > 0 .and. &
                min(foil%pitch%value, foil%half_length%value, foil%height%value) > 0.0_wp
    mesh%align_crests = can_align
    call keys%logical_key('align_crests', mesh%align_crests, &
                          'put lines of nodes of film and top foil above the crests; the '// &
                          'number of elements is then near circumferential_elements', &
                          default='`.true.` for shells and beams with bumps')
    call keys%rule('mesh', 'align_crests', mesh%align_crests .and. .not. can_align .and. &
                   model%foil%is_known(), "needs foil = 'shell', and bumps, pitch, "// &
                   "half_length and height in &bump_foil; 'beam' will do, too")
  end subroutine read_mesh_case

  !> Radius at which a pitch is measured [m].
  pure real(wp) function foil_radius(bearing, model) result(radius)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for

    radius = bearing%radius
    if (model%foil%has_top_foil) radius = middle_radius(bearing)
  end function foil_radius

  !> Elements along the pad where the case does not say: whole pitches that cover it.
  pure integer function elements_along_pad(bearing, foil, model) result(elements)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    real(wp), parameter :: rounding = 1.0e-9_wp !! whole pitches are not rounded up, relative
    real(wp) :: pitches

    elements = bearing%row%elements
    if (.not. bearing%radius > 0.0_wp) return
    if (foil%pitch%value > 0.0_wp) then
      pitches = pad_angle(bearing)*foil_radius(bearing, model)/foil%pitch%value*(1.0_wp - rounding)
    else if (size(foil%crest_angles) > 1) then
      associate (crests => foil%crest_angles, n => size(foil%crest_angles))
        pitches = pad_angle(bearing)/(max(crests(n) - crests(1), tiny(1.0_wp))/real(n - 1, wp))
        pitches = pitches*(1.0_wp - rounding)
      end associate
    else
      return
    end if
    elements = elements_a_pitch*ceiling(min(pitches, real(most_a_side, wp)))
    if (foil%strip_form == strip_straight) elements = 2*elements ! crests cross them
    if (model%foil%has_top_foil) elements = max(elements, bearing%row%fewest_elements)
  end function elements_along_pad
end module gfb_mesh_case
