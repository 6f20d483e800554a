!> What a scene of foils alone needs, and no more; each choice with its reason.
module gfb_foil_plan
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_scene_rules, only: is_symmetric, what_factors_do
  use gfb_model_case, only: half_width_auto, half_width_yes, reduction_guyan, reduction_none, &
                            reduction_auto
  use gfb_study_cases, only: part_words, part_strip
  use gfb_foil_cases, only: bump_foil_case_type, fixed_edge_none, has_flats, strips_differ, &
                            sizes_mirror
  use gfb_strip_load_case, only: support_held, load_plates
  use gfb_foil_rules, only: strips_mirror
  use gfb_mesh_case, only: linear_solver_direct, linear_solver_out_of_core, &
                           linear_solver_iterative, linear_solver_auto
  use gfb_memory_check, only: show_memory
  use gfb_memory_laws, only: strip_memory, bearing_memory, modes_memory
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_builder, only: foil_plan_type, plate_stations, stations_follow_crests
  implicit none (type, external)
  private
  public :: plan_foil, choose_solution, film_elements, solved_rows, count_bumps, has_friction, &
            show_strips, strips_mirror

  !> Condensed bumps may take so many times what all unknowns take, by the laws: they have fewer of
  !> them to go through in each step. Of 18 scenes that were measured with both the choice was the
  !> faster one, or less than a fifth slower, in 17.
  real(wp), parameter :: most_times = 1.5_wp

  !> Unknowns of a bearing of shells from which on iterations take no more time than factors, and
  !> half the memory: docs/measured/memory.md has 414,579 (37 and 30 s) and 929,932 (86 and 138 s).
  real(wp), parameter :: many_unknowns = 5.0e5_wp

contains

  !> Replaces what is asked of `auto` by what costs less, with the reasons in words.
  subroutine choose_solution(scene)
    type(scene_type), intent(inout) :: scene !! gets its reduction and its linear solver
    call choose_linear_solver(scene)
    call choose_reduction(scene)
  end subroutine choose_solution

  !> Replaces `linear_solver = 'auto'` by iterations where there are many unknowns and nothing needs
  !> factors, by factors in memory elsewhere.
  subroutine choose_linear_solver(scene)
    type(scene_type), intent(inout) :: scene
    real(wp) :: unknowns, nodes
    integer :: rows, stations

    if (scene%solver%linear_solver /= linear_solver_auto) return
    scene%solver%linear_solver = linear_solver_direct
    if (.not. scene%general%analysis%has_film) return
    if (what_factors_do(scene) /= '' .or. scene%dynamics%present) return
    if (scene%model%reduction == reduction_guyan) return
    rows = solved_rows(scene, solves_half(scene))
    call count_bumps(scene, rows, .false., stations, unknowns)
    nodes = real(film_stations(scene), wp)*real(rows, wp)
    unknowns = scene%bearing%all_pads()*(unknowns + (node_unknowns + 1)*nodes)
    if (unknowns < many_unknowns) return
    scene%solver%linear_solver = linear_solver_iterative
    scene%solver%solver_chosen = .true.
  end subroutine choose_linear_solver

  !> Whether half the width is solved.
  pure logical function solves_half(scene) result(half)
    type(scene_type), intent(in) :: scene !! with bumps of shells

    half = scene%model%half_width == half_width_yes
    if (scene%model%half_width /= half_width_auto) return
    half = modulo(scene%mesh%axial_elements, 2) == 0 .and. sizes_mirror(scene%bump_foil)
    if (.not. scene%general%analysis%loads_strip) half = half .and. is_symmetric(scene)
  end function solves_half

  !> Elements of the film along the pad.
  function film_elements(scene) result(elements)
    type(scene_type), intent(in) :: scene !! of a bearing
    integer :: elements

    elements = scene%mesh%circumferential_elements
    if (.not. scene%model%foil%has_bumps) return
    if (stations_follow_crests(scene)) elements = size(plate_stations(scene)) - 1
  end function film_elements

  !> Nodes of film and top foil along the pad.
  function film_stations(scene) result(stations)
    type(scene_type), intent(in) :: scene !! of a bearing of shells
    integer :: stations
    stations = scene%model%film_order*film_elements(scene) + 1
  end function film_stations

  !> Rows of nodes over the width that is solved.
  pure integer function solved_rows(scene, half) result(rows)
    type(scene_type), intent(in) :: scene !! with a mesh
    logical, intent(in) :: half !! of the width

    rows = scene%model%film_order*scene%mesh%axial_elements
    if (half) rows = rows/2
    rows = rows + 1
  end function solved_rows

  !> Replaces `reduction = 'auto'` by what costs less in most scenes, with the reason in words, by
  !> the memory laws: they count entries, which time follows.
  subroutine choose_reduction(scene)
    type(scene_type), intent(inout) :: scene !! gets its reduction, if it asks for a choice
    real(wp) :: times

    if (scene%model%reduction /= reduction_auto) return
    scene%model%reduction = reduction_guyan
    if (.not. scene%model%foil%has_shell_bumps .or. scene%general%analysis%finds_modes) return
    if (scene%solver%linear_solver == linear_solver_iterative) then
      scene%model%reduction = reduction_none
      scene%model%reduction_reason = 'all unknowns, because linear systems are iterated'
      return
    end if
    times = cost_of_lines(scene, solved_rows(scene, solves_half(scene)))
    scene%model%reduction_reason = 'condensed, by '//text(times, 2)// &
                                   ' times the count of all unknowns'
    if (times <= most_times) return
    scene%model%reduction = reduction_none
    scene%model%reduction_reason = 'all unknowns, because condensed ones count '// &
                                   text(times, 2)//' times'
  end subroutine choose_reduction

  !> What condensed bumps take by the memory laws, over what all unknowns take.
  function cost_of_lines(scene, rows) result(times)
    type(scene_type), intent(in) :: scene !! with bumps of shells
    integer, intent(in) :: rows           !! of nodes over the width that is solved
    real(wp) :: times                     !! [1]
    real(wp) :: memory(2), unknowns
    integer :: kind, stations

    do kind = 1, 2
      call count_bumps(scene, rows, kind == 1, stations, unknowns)
      associate (solver => scene%solver%linear_solver)
        if (scene%general%analysis%loads_strip) then
          memory(kind) = strip_memory(unknowns, stations, rows, kind == 1, &
                                      has_friction(scene), solver)
        else
          memory(kind) = bearing_memory(film_stations(scene)*rows, unknowns, rows, kind == 1, &
                                        solver)
        end if
      end associate
    end do
    times = memory(1)/memory(2)
  end function cost_of_lines

  !> Chooses width and reduction, and logs why.
  subroutine plan_foil(scene, log, plan)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    type(foil_plan_type), intent(out) :: plan !! what was chosen
    logical :: strip

    strip = scene%general%analysis%loads_strip
    call log%heading('what the scene needs')
    if (strip) then
      call show_contacts(scene, log)
    else
      call log%line('modes of the '//trim(part_words(scene%modes%part))//' as shells')
    end if
    plan%half = scene%model%half_width == half_width_yes
    if (scene%model%half_width == half_width_auto) then
      plan%half = strip .and. modulo(scene%mesh%axial_elements, 2) == 0
      plan%half = plan%half .and. strips_mirror(scene)
      if (strip .and. .not. strips_mirror(scene)) then
        call log%line('width: whole, because the strips do not mirror each other')
      else if (plan%half) then
        call log%line('width: half, with symmetry at z = 0, because the loads are')
      else if (strip) then
        call log%line('width: whole, because axial_elements is odd')
      else
        call log%line('width: whole, because modes need not be symmetric')
      end if
    else if (plan%half .and. .not. strip) then
      call log%line('width: half, as half_width asks: only modes symmetric about z = 0 are found')
    else
      call log%line('width: '//trim(merge('half ', 'whole', plan%half))//', as half_width asks')
    end if
    plan%reduced = strip .and. scene%model%reduction == reduction_guyan
    if (strip .and. allocated(scene%model%reduction_reason)) then
      call log%line('bumps: '//scene%model%reduction_reason)
    else if (plan%reduced) then
      call log%line('bumps: condensed onto corners, crests and the free edge, equal ones once')
    else if (strip) then
      call log%line('bumps: all unknowns, as reduction asks')
    end if
    plan%pinned = strip .and. scene%bump_foil%fixed_edge == fixed_edge_none .and. &
                  .not. has_friction(scene)
    if (plan%pinned) then
      call log%line('strip: fixed nowhere and without friction; its gliding on the sleeve is '// &
                    'removed at one node')
    else if (scene%bump_foil%fixed_edge == fixed_edge_none .and. strip) then
      call log%line('strip: fixed nowhere; friction alone holds it')
    else if (scene%bump_foil%fixed_edge == fixed_edge_none .and. &
             scene%modes%part == part_strip) then
      call log%line('strip: free; it has six rigid motions')
    end if
    if (strip .or. scene%modes%part == part_strip) call show_sizes(scene, plan, log)
  end subroutine plan_foil

  !> Describes strips with sizes of their own.
  subroutine show_strips(foil, log)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    type(run_log_type), intent(in) :: log !! where lines go

    if (.not. strips_differ(foil)) return
    call log%line('strips: '//text(foil%strips)//' side by side with sizes of their own; '// &
                  'scales and mesh lines follow their mean')
  end subroutine show_strips

  !> Whether anything rubs.
  pure logical function has_friction(scene) result(friction)
    type(scene_type), intent(in) :: scene !! of a strip

    associate (contact => scene%contact)
      friction = contact%friction_top > 0.0_wp
      if (scene%strip_load%support /= support_held) then
        friction = friction .or. contact%friction_sleeve > 0.0_wp
      end if
    end associate
  end function has_friction

  !> Load, contacts and friction of a strip.
  subroutine show_contacts(scene, log)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: words

    words = 'bump strip of '//text(scene%bump_foil%bumps)//' bumps as shells, '
    associate (load => scene%strip_load, contact => scene%contact)
      if (load%kind == load_plates) then
        words = words//'between two rigid plates'
      else if (contact%friction_top > 0.0_wp) then
        words = words//'crests loaded and rubbing on an immobile plate'
      else
        words = words//'crests loaded'
      end if
      if (load%support == support_held) words = words//', corner lines held in v'
      call log%line(words)
      call show_strips(scene%bump_foil, log)
      if (has_friction(scene)) then
        call log%line('friction: '//text(contact%friction_top, 4)//' on top, '// &
                      text(contact%friction_sleeve, 4)//' on the sleeve, stick length '// &
                      text(contact%stick_length*1.0e9_wp, 4)//' nm')
      else
        call log%line('friction: none, so the matrix is symmetric and steps have no memory')
      end if
    end associate
  end subroutine show_contacts

  !> Sizes of a strip and the memory they take.
  subroutine show_sizes(scene, plan, log)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(inout) :: plan
    type(run_log_type), intent(in) :: log
    integer :: stations, rows
    real(wp) :: unknowns, retained

    rows = merge(scene%mesh%axial_elements/2, scene%mesh%axial_elements, plan%half) + 1
    call count_bumps(scene, rows, plan%reduced, stations, unknowns)
    if (scene%general%analysis%loads_strip) then
      plan%memory = strip_memory(unknowns, stations, rows, plan%reduced, has_friction(scene), &
                                 scene%solver%linear_solver)
    else
      call count_bumps(scene, rows, .true., stations, retained)
      plan%memory = modes_memory(unknowns, retained, stations, rows)
    end if
    call log%line('strip mesh: '//text(stations)//' x '//text(rows)//' nodes solved, about '// &
                  text(nint(unknowns))//' unknowns before supports')
    call show_linear_solver(scene, plan, log)
    call show_memory(plan%memory, log)
  end subroutine show_sizes

  !> How a strip's linear systems are solved.
  subroutine show_linear_solver(scene, plan, log)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: words

    words = 'LU, because friction makes the matrix unsymmetric'
    if (.not. has_friction(scene)) words = 'Cholesky, because the matrix is symmetric and definite'
    select case (scene%solver%linear_solver)
    case (linear_solver_out_of_core)
      words = words//'; factors in files, as linear_solver asks'
    case (linear_solver_iterative)
      words = 'conjugate gradients'
      if (has_friction(scene)) words = 'GMRES'
      words = words//' on two levels, as linear_solver asks'
    case default ! factors in memory
    end select
    if (plan%memory > 0.0_wp) call log%line('linear solver: '//words)
  end subroutine show_linear_solver

  !> Stations and unknowns of the bump foil, before supports.
  pure subroutine count_bumps(scene, rows, reduced, stations, unknowns)
    type(scene_type), intent(in) :: scene !! what is asked for
    integer, intent(in) :: rows           !! that are solved
    logical, intent(in) :: reduced        !! bumps are condensed
    integer, intent(out) :: stations !! along the foil
    real(wp), intent(out) :: unknowns     !! may be more than an integer holds [1]
    integer :: lines

    associate (foil => scene%bump_foil, mesh => scene%mesh)
      stations = foil%bumps*(mesh%arc_elements + merge(mesh%flat_elements, 0, has_flats(foil))) + 1
      lines = foil%bumps*merge(3, 2, has_flats(foil)) + 1
    end associate
    unknowns = real(node_unknowns*merge(lines, stations, reduced), wp)*rows
  end subroutine count_bumps
end module gfb_foil_plan
