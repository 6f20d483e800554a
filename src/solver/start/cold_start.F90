#include "gfb_petsc.h"
!> The first answer of a scene, from nothing.
!>
!> A scene is solved on smaller systems first, from the coarsest that `smaller_start.F90` finds to its own. Each starts from
!> the answer of the one before, and from nothing only if that fails: `start_list.F90` has the starts, in order.
!>
!> What `search_stages.F90` adds to the first answer comes on the first mesh that has one; all finer ones begin with it, and a
!> refusal with heat is shown on them from the state where it ended, never searched again.
module gfb_cold_start
  use gfb_kinds, only: wp
  use gfb_ending, only: ending_lost, ending_stopped, ending_fold, ending_emptied
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_scene, only: scene_type
  use gfb_film_surface, only: translations
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_builder, only: build_bearing
  use gfb_newton, only: newton_type, create_newton, destroy_newton
  use gfb_continuation, only: path_report_type
  use gfb_heat_start, only: carry_heat, show_heat
  use gfb_start_problem, only: search_request_type, start_problem_type, drop_bearing, count_spent
  use gfb_saved_state, only: saved_state_type
  use gfb_search_stages, only: stages_of, take_heat_away, start_pressed, take_stages, stage_interference
  use gfb_smaller_start, only: find_smaller, find_between, lies_between
  use gfb_answer_transfer, only: transfer_answer
  use gfb_partitioned, only: partitioned_type, create_partitioned, follow_partitioned
  use gfb_foil_row, only: foil_rigid
  implicit none (type)
  private
  public :: start_bearing, start_partitioned

  integer, parameter :: most_meshes = 24 !! each has half the elements of the next one at least, or lies between two

  !> A mesh between the coarsest and the scene's, with its equations.
  type :: mesh_type
    type(scene_type), allocatable :: scene ! large
    type(bearing_plan_type) :: plan
    type(bearing_system_type), pointer :: bearing => null() !! null: not built yet
    type(newton_type), pointer :: newton => null()
    type(path_report_type) :: report !! of its search
    logical :: divided = .false.     !! another one has been put between it and the one before
    logical :: heated = .false.      !! its state is one with heat
    type(saved_state_type) :: anchor  !! a state to show a refusal from on the next mesh, too
  end type mesh_type

contains

  !> Builds a scene's equations and finds their answer at an operating point, with heat or without it, on smaller meshes first. A
  !> bearing that there is already is built anew, and what was spent on it counts.
  !>
  !> Fails when the mesh cannot be cut; a scene without an answer is a report, not an error.
  subroutine start_bearing(request, bearing, newton, report, error)
    type(search_request_type), intent(in) :: request !! what is searched, and how
    type(bearing_system_type), target, intent(inout) :: bearing !! is built
    type(newton_type), target, intent(inout) :: newton          !! its solver, is created
    type(path_report_type), intent(out) :: report        !! of the start that led to the answer, or nearest to one
    type(error_type), allocatable, intent(out) :: error !! why it could not be done

    call begin_search(request)
    call search_meshes(request, bearing, newton, report, error)
    if (.not. allocated(error)) call end_search(request, report)
  end subroutine start_bearing

  !> Begins to count what a search costs, where it is bounded.
  subroutine begin_search(request)
    type(search_request_type), intent(in) :: request
    if (.not. associated(request%tolerances%bound)) return
    call request%tolerances%bound%begin(request%scene%solver%most_factorizations, request%scene%solver%most_work)
  end subroutine begin_search

  !> What follows a search from nothing is not bounded; one that gave up says so.
  subroutine end_search(request, report)
    type(search_request_type), intent(in) :: request
    type(path_report_type), intent(inout) :: report !! of the search
    logical :: gave_up

    if (.not. associated(request%tolerances%bound)) return
    associate (bound => request%tolerances%bound)
      gave_up = bound%is_reached() .and. .not. report%converged()
      call bound%lift()
      if (.not. gave_up) return
      call request%log%line('the search from nothing gave up '//bound%words()//'; a sweep from a lighter load, a lower '// &
                            'speed or less tilt may lead there')
      if (report%has_cause()) return
      report%ending%kind = ending_stopped
      call report%ending%add_words('', ', '//bound%words())
    end associate
  end subroutine end_search

  !> All meshes, the coarsest first. Where the answer of one with few rows does not lead to the next, one with half the rows is put
  !> in between.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine search_meshes(request, bearing, newton, report, error)
    type(search_request_type), intent(in) :: request
    type(bearing_system_type), target, intent(inout) :: bearing !! is built
    type(newton_type), target, intent(inout) :: newton          !! its solver, is created
    type(path_report_type), intent(out) :: report
    type(error_type), allocatable, intent(out) :: error
    type(mesh_type), allocatable, target :: mesh(:) ! the scene's is the first
    type(mesh_type), pointer :: before ! the one that was searched before
    integer, allocatable :: left(:) ! numbers of the meshes that are still to be searched, the next one last
    integer :: meshes, spent(3), spent_before(3)
    logical :: between, smaller

    spent_before = 0
    if (newton%created) call drop_bearing(bearing, newton, spent_before)
    allocate (mesh(most_meshes))
    allocate (mesh(1)%scene, source=request%scene)
    mesh(1)%plan = request%plan
    mesh(1)%bearing => bearing
    mesh(1)%newton => newton
    if (.not. request%scene%thermal%present) call build_mesh(request, mesh(1), .false., error)
    if (allocated(error)) return
    left = [1]
    meshes = 1
    do while (meshes < most_meshes)
      allocate (mesh(meshes + 1)%scene)
      call find_smaller(mesh(meshes)%scene, mesh(meshes)%plan, request%target, smaller, mesh(meshes + 1)%scene, mesh(meshes + 1)%plan)
      if (.not. smaller) exit
      meshes = meshes + 1
      left = [left, meshes]
    end do
    before => null()
    spent = 0
    do while (size(left) > 0)
      associate (here => mesh(left(size(left))))
        if (.not. associated(here%bearing)) allocate (here%bearing, here%newton)
        if (meshes > 1) call request%log%is_on('mesh '//text(meshes - size(left) + 1)//' of '//text(meshes)//' ('//size_words(here)//')')
        call search_mesh(request, here, before, between, error)
        if (allocated(error)) return
        if (between .and. meshes < most_meshes) then
          call request%log%line('no answer from that of '//text(before%plan%axial)//' rows ('//here%report%reason()//'); half of '// &
                                text(here%plan%axial)//' first:')
          here%divided = .true.
          meshes = meshes + 1
          if (.not. allocated(mesh(meshes)%scene)) allocate (mesh(meshes)%scene)
          call find_between(here%scene, here%plan, mesh(meshes)%scene, mesh(meshes)%plan)
          left = [left, meshes]
          cycle
        end if
      end associate
      if (associated(before)) call drop_mesh(before, spent)
      before => mesh(left(size(left)))
      left = left(:size(left) - 1)
      if (size(left) > 0 .and. .not. before%report%converged()) then
        call request%log%line('no answer on the mesh of '//size_words(before)//' ('//before%report%reason()//'); the mesh of '// &
                              size_words(mesh(left(size(left))))//' follows')
      end if
    end do
    call request%log%is_on('')
    call mesh(1)%anchor%destroy()
    spent(3) = spent(2)
    call count_spent(newton, spent + spent_before)
    report = mesh(1)%report
    if (any(report%ending%kind == [ending_lost, ending_stopped]) .and. bearing%floats .and. .not. mesh(1)%heated) then
      call report%ending%add_words(lost_words(report, request%target), '')
    end if
  end subroutine search_meshes

  !> Builds a mesh's equations, with the heat of its scene or at ambient temperature; those that it has the same way stay. What was
  !> spent on others counts.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine build_mesh(request, mesh, hot, error)
    type(search_request_type), intent(in) :: request
    type(mesh_type), intent(inout) :: mesh
    logical, intent(in) :: hot !! with heat
    type(error_type), allocatable, intent(out) :: error
    type(scene_type), allocatable :: cold
    integer :: spent(3)

    if (mesh%newton%created) then
      if (mesh%bearing%heat%present .eqv. hot) return
      call drop_bearing(mesh%bearing, mesh%newton, spent)
    else
      spent = 0
    end if
    if (hot) then
      call build_bearing(mesh%scene, mesh%plan, mesh%bearing, error)
    else
      call take_heat_away(mesh%scene, request%target, cold)
      call build_bearing(cold, mesh%plan, mesh%bearing, error)
    end if
    if (allocated(error)) return
    call create_newton(mesh%newton, mesh%bearing, 'bearing_', request%tolerances, request%log)
    call count_spent(mesh%newton, spent)
  end subroutine build_mesh

  !> Frees a smaller mesh's equations; what they have cost counts.
  subroutine drop_mesh(mesh, spent)
    type(mesh_type), intent(inout) :: mesh
    integer, intent(inout) :: spent(3) !! iterations and factorizations so far
    integer :: more(3)

    call mesh%anchor%destroy()
    call drop_bearing(mesh%bearing, mesh%newton, more)
    deallocate (mesh%bearing, mesh%newton)
    spent = spent + more
  end subroutine drop_mesh

  !> The elements of a mesh, around and along the axis.
  function size_words(mesh) result(words)
    type(mesh_type), intent(in) :: mesh
    character(len=:), allocatable :: words
    words = text(mesh%plan%circumferential)//' x '//text(mesh%plan%axial)
  end function size_words

  !> How far the search came, in words.
  function lost_words(report, target) result(words)
    type(path_report_type), intent(in) :: report !! of the last state
    type(operating_point_type), intent(in) :: target !! asked for
    character(len=:), allocatable :: words

    if (report%shaft_fixed) then
      words = 'lost before the shaft is released: '
    else if (norm2(target%load(:translations)) > 0.0_wp) then
      words = 'lost at '//text(100.0_wp*norm2(report%reached%load(:translations))/norm2(target%load(:translations)), 3)// &
              ' % of the load: '
    else
      words = 'lost: '
    end if
  end function lost_words

  !> Searches one mesh for the answer: from that of the mesh before, with all stages that this has gone through, or else from nothing,
  !> and through them then.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine search_mesh(request, mesh, before, between, error)
    type(search_request_type), intent(in) :: request
    type(mesh_type), target, intent(inout) :: mesh
    type(mesh_type), pointer, intent(in) :: before !! the mesh that was searched before; null: there is none
    logical, intent(out) :: between !! another one is needed between them
    type(error_type), allocatable, intent(out) :: error
    type(scene_type), target, allocatable :: cold
    type(start_problem_type), allocatable :: problem
    type(mesh_type), pointer :: helper
    integer, allocatable :: stages(:)
    logical :: settled

    between = .false.
    helper => before
    mesh%heated = .false.
    if (associated(before)) mesh%heated = before%heated
    call build_mesh(request, mesh, mesh%heated, error)
    if (allocated(error)) return
    call request%log%stage('film '//size_words(mesh))
    if (mesh%heated) then
      call search_hot(request, mesh, before, between, settled)
      if (between .or. settled) return
      call request%log%line('no answer from the smaller mesh''s with heat ('//mesh%report%reason()//'): from nothing')
      helper => null()
      mesh%heated = .false.
      call build_mesh(request, mesh, .false., error)
      if (allocated(error)) return
    end if
    allocate (problem)
    call set_problem(request, mesh, problem)
    call take_heat_away(mesh%scene, request%target, cold)
    problem%scene => cold
    call search_cold(mesh, helper, problem, between)
    if (between .or. problem%from_smaller .or. .not. mesh%report%converged()) return
    problem%scene => mesh%scene
    mesh%heated = mesh%scene%thermal%present
    stages = stages_of(mesh%scene)
    call take_stages(pack(stages, stages > stage_interference), problem, mesh%report)
  end subroutine search_mesh

  !> What is to be solved on a mesh.
  subroutine set_problem(request, mesh, problem)
    type(search_request_type), intent(in) :: request
    type(mesh_type), target, intent(in) :: mesh
    type(start_problem_type), intent(inout) :: problem

    problem%search_request_type = request
    problem%scene => mesh%scene
    problem%plan = mesh%plan
    problem%bearing => mesh%bearing
    problem%newton => mesh%newton
  end subroutine set_problem

  !> On from the state with heat of the mesh before: its answer, or where its search ended.
  subroutine search_hot(request, mesh, before, between, settled)
    type(search_request_type), intent(in) :: request
    type(mesh_type), target, intent(inout) :: mesh
    type(mesh_type), intent(inout) :: before
    logical, intent(out) :: between !! another mesh is needed between them
    logical, intent(out) :: settled !! there is an answer, or none is to be looked for
    type(start_problem_type), allocatable :: problem

    allocate (problem)
    call set_problem(request, mesh, problem)
    problem%smaller => before%bearing
    if (before%report%converged()) then
      call carry_heat(problem, mesh%report)
      settled = mesh%report%converged()
      if (.not. settled) settled = gives_up(mesh%newton%settings%bound)
      between = .not. (settled .or. mesh%divided) .and. lies_between(mesh%plan, before%plan)
    else
      problem%refusal = before%report
      call show_heat(problem, mesh%report)
      if (.not. (before%report%of_smaller .or. mesh%report%has_cause() .or. mesh%report%converged())) then
        mesh%report%of_smaller = .true.
        if (mesh%report%ending%kind /= ending_stopped) call mesh%report%ending%add_words('', ', as the mesh of '//size_words(before)//' has it')
      end if
      settled = .true.
      between = .false.
    end if
  end subroutine search_hot

  !> The starts on one mesh without heat, from the answer of the mesh before or from nothing.
  subroutine search_cold(mesh, before, problem, between)
    type(mesh_type), target, intent(inout) :: mesh
    type(mesh_type), pointer, intent(in) :: before !! the mesh that was searched before; null: there is none
    type(start_problem_type), intent(inout) :: problem !! what is to be solved on this one
    logical, intent(out) :: between !! another one is needed between them
    logical :: helped, again, has_contacts

    has_contacts = mesh%bearing%has_contacts()
    helped = .false.
    if (associated(before)) helped = before%report%converged()
    ! After a mesh in between has failed there is none to begin from; a film alone is cheap, and has answers that its coarse mesh lacks.
    problem%refused = associated(before) .and. .not. (helped .or. mesh%divided) .and. has_contacts
    if (helped) problem%smaller => before%bearing
    if (problem%refused) then
      problem%refusal = before%report
      if (before%anchor%created) call before%anchor%restore(before%bearing)
      if (before%anchor%created .or. .not. before%report%shaft_fixed) problem%smaller => before%bearing
    end if
    if (helped) problem%carried_only = lies_between(mesh%plan, before%plan) .and. .not. mesh%divided
    call start_pressed(problem, mesh%report)
    between = problem%carried_only .and. .not. mesh%report%converged()
    if (between) between = .not. gives_up(mesh%newton%settings%bound)
    if (between) return
    associate (report => mesh%report)
      again = .not. (report%converged() .or. mesh%plan%upwind .or. has_contacts .or. problem%no_room) .and. mesh%plan%may_upwind
      ! Where the film is emptied or its branch folds SUPG ends there, too; where the shaft touches down it may not.
      if (again) again = all(report%ending%kind /= [ending_fold, ending_emptied])
      if (again) again = .not. gives_up(mesh%newton%settings%bound)
      if (again) then
        mesh%bearing%pad%film%flow%upwind = .true.
        call problem%newton%log%line('film: Galerkin finds no answer, SUPG is tried')
        call start_pressed(problem, report)
      end if
      if (problem%refused .and. .not. (report%converged() .or. report%has_cause())) then
        report%ending = problem%refusal%ending ! of all starts, not of one
        report%of_smaller = .true.
        if (.not. problem%refusal%of_smaller .and. report%ending%kind /= ending_stopped) then
          call report%ending%add_words('', ', as the mesh of '//size_words(before)//' has it')
        end if
      end if
      mesh%anchor = problem%anchor
    end associate
  end subroutine search_cold

  !> Builds a scene's equations and finds their answer by loops, from the film of a rigid foil.
  !>
  !> Fails when the mesh cannot be cut; a scene without an answer is a report, not an error.
  subroutine start_partitioned(request, bearing, newton, sides, report, error)
    type(search_request_type), intent(in) :: request !! what is searched, and how
    type(bearing_system_type), target, intent(inout) :: bearing !! is built
    type(newton_type), target, intent(inout) :: newton !! of the coupled equations: only counts here
    type(partitioned_type), target, intent(inout) :: sides !! are created
    type(path_report_type), intent(out) :: report !! how it ended
    type(error_type), allocatable, intent(out) :: error !! why it could not be done

    type(search_request_type) :: of_film
    type(bearing_system_type), allocatable, target :: rigid
    type(newton_type), allocatable, target :: rigid_newton
    type(scene_type), allocatable, target :: stiff
    real(wp), allocatable :: unknown(:)
    integer :: i

    allocate (rigid, rigid_newton)
    call build_bearing(request%scene, request%plan, bearing, error)
    if (allocated(error)) return
    call create_newton(newton, bearing, 'bearing_', request%tolerances, request%log)
    stiff = request%scene
    stiff%model%foil = foil_rigid
    of_film = request
    of_film%scene => stiff
    call begin_search(request)
    call search_meshes(of_film, rigid, rigid_newton, report, error)
    if (allocated(error)) return
    newton%iterations = rigid_newton%iterations
    newton%factorizations = rigid_newton%factorizations
    newton%factorizations_before = rigid_newton%factorizations
    bearing%point = request%target
    bearing%pad%film%flow%upwind = rigid%upwinds()
    call transfer_answer(rigid, bearing)
    allocate (unknown(bearing%local_size()))
    call bearing%get_unknowns(unknown)
    do i = 1, size(bearing%pad)
      unknown(bearing%pad(i)%first + bearing%pad(i)%foil%first + 1:bearing%pad(i)%last) = 0.0_wp ! at rest
    end do
    call bearing%set_unknowns(unknown)
    call create_partitioned(bearing, request%tolerances, request%log, sides)
    if (report%converged()) then
      call request%log%line('partitioned: starts from the film of a rigid foil, found by '// &
                    text(newton%iterations)//' Newton iterations, and the foil at rest')
      call follow_partitioned(bearing, newton, request%target, request%settings, sides, report)
    else
      call report%ending%add_words('the film of a rigid foil, where the loops start: ', '')
    end if
    call end_search(request, report)
    call destroy_newton(rigid_newton)
    call rigid%destroy()
  end subroutine start_partitioned
end module gfb_cold_start
