!> A scene on nested meshes, until the error of one number is as small as asked for.
module gfb_accuracy_analysis
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_accuracy_case, only: asked_name
  use gfb_accuracy_study, only: accuracy_study_type, start_study
  use gfb_bearing_refinement, only: refined_bearing_type, keep_scheme
  use gfb_model_case, only: foil_shell, foil_beam
  use gfb_nested_meshes, only: nested_mesh, mesh_words, formal_order
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_quantity, only: quantity_type
  use gfb_refined_run, only: refined_run_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_strip, is_bearing
  use gfb_scene_rules, only: is_symmetric
  use gfb_strip_refinement, only: refined_strip_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: run_accuracy

contains

  !> Refines, and writes the results of the finest mesh.
  !>
  !> `converged` is false where there is no answer, or none that is known as well as asked for.
  !> Fails when a mesh cannot be made or a file cannot be written.
  subroutine run_accuracy(scene, folder, command, start_time, log, converged, error, answer)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder   !! where the results go
    character(len=*), intent(in) :: command  !! the whole command line
    real(wp), intent(in) :: start_time       !! of the run [s]
    type(run_log_type), intent(in) :: log
    logical, intent(out) :: converged
    type(error_type), allocatable, intent(out) :: error
    type(quantity_type), allocatable, intent(out), optional :: answer(:) !! what the summary has

    class(refined_run_type), allocatable, target :: run
    type(accuracy_study_type) :: study
    type(scene_type) :: mesh
    type(quantity_type), allocatable :: summary(:)
    character(len=:), allocatable :: stopped, beams

    converged = .false.
    call refine(scene, log, study, mesh, run, stopped, beams, error)
    if (allocated(error)) return
    converged = study%met()
    call run%write(mesh, folder, command, start_time, converged, study%quantities(), log, summary, &
                   error)
    if (allocated(error)) return
    call study%show(log)
    call conclude(log, study, stopped, run%left_out(scene)//beams)
    call run%discard()
    if (present(answer)) call move_alloc(summary, answer)
  end subroutine run_accuracy

  !> Solves on finer and finer meshes; leaves the finest one's answer.
  !>
  !> Fails when a mesh cannot be made, or the first one needs more memory than there is.
  subroutine refine(scene, log, study, mesh, run, stopped, beams, error)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(accuracy_study_type), intent(out) :: study
    type(scene_type), intent(out) :: mesh                !! the scene on its finest mesh
    class(refined_run_type), allocatable, target, intent(out) :: run
    character(len=:), allocatable, intent(out) :: stopped !! why there are no more meshes
    character(len=:), allocatable, intent(out) :: beams   !! what beams would do, part of a sentence
    type(error_type), allocatable, intent(out) :: error

    class(refined_run_type), allocatable :: next
    type(run_log_type) :: quiet
    type(scene_type) :: trial
    integer :: number, cost(2)

    quiet = log
    quiet%active = .false.
    stopped = 'maximum_refinements is '//text(scene%accuracy%maximum_refinements)
    beams = ''
    study = start_study(scene%accuracy, formal_order(scene))
    call show_plan(scene, log, trial)
    cost = 0
    do number = 0, scene%accuracy%maximum_refinements
      trial%mesh = nested_mesh(scene, number)
      call create_run(scene, next)
      call next%prepare(trial, quiet, error)
      if (allocated(error)) then
        if (number == 0) return
        stopped = error%message
        deallocate (error)
        exit
      end if
      if (allocated(run)) call run%discard()
      call move_alloc(next, run)
      mesh = trial
      call log%heading('mesh '//text(number + 1)//': '//mesh_words(trial)//' elements')
      call solve_mesh(trial, log, run, study, error)
      if (allocated(error)) return
      cost = cost + [run%iterations, run%factorizations]
      if (study%met()) exit
      if (beams == '' .and. size(study%value) == 1) then
        call compare_beams(trial, log, quiet, study, beams)
      end if
    end do
    run%iterations = cost(1)
    run%factorizations = cost(2)
  end subroutine refine

  !> Says what the scene needs on the mesh of its case, and with which meshes the refinement begins;
  !> all of them have the film's weighting of that one.
  subroutine show_plan(scene, log, trial)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(out) :: trial !! with its weighting chosen
    class(refined_run_type), allocatable :: run
    type(error_type), allocatable :: error !! of no use: a coarser mesh may fit into memory

    call create_run(scene, run)
    call run%prepare(scene, log, error)
    trial = scene
    if (is_bearing(scene%general%analysis)) call keep_scheme(trial)
    trial%mesh = nested_mesh(scene, 0)
    call log%line('accuracy: error of '//asked_name(scene%accuracy)// &
                  ' from meshes that begin with '//mesh_words(trial)// &
                  ' elements and are doubled each way')
  end subroutine show_plan

  !> A run of a scene's analysis.
  subroutine create_run(scene, run)
    type(scene_type), intent(in) :: scene
    class(refined_run_type), allocatable, intent(out) :: run

    if (scene%general%analysis == analysis_strip) then
      allocate (refined_strip_type :: run)
    else
      allocate (refined_bearing_type :: run)
    end if
  end subroutine create_run

  !> Solves on one mesh and judges its value.
  !>
  !> Fails when the mesh cannot be made.
  subroutine solve_mesh(scene, log, run, study, error)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    class(refined_run_type), target, intent(inout) :: run
    type(accuracy_study_type), intent(inout) :: study
    type(error_type), allocatable, intent(out) :: error
    real(wp) :: begun, seconds
    integer :: place

    begun = cpu_seconds()
    call run%solve(scene, log, error)
    if (allocated(error)) return
    seconds = cpu_seconds() - begun
    place = place_of(study%name, run%found)
    if (run%converged .and. place > 0) then
      call study%add(mesh_words(scene), run%found(place), run%unknowns, seconds)
      call log%line(study%value_words())
    else
      call study%add_failure(mesh_words(scene), run%unknowns, seconds)
      call log%line('no '//study%name//' on this mesh: only finer ones count')
    end if
  end subroutine solve_mesh

  !> Solves a coarse mesh of shells with beams instead, and says whether they would have done.
  subroutine compare_beams(scene, log, quiet, study, words)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log, quiet
    type(accuracy_study_type), intent(in) :: study
    character(len=:), allocatable, intent(out) :: words !! part of a sentence

    type(refined_bearing_type), target :: run
    type(scene_type) :: beams
    type(error_type), allocatable :: error
    real(wp) :: off
    integer :: place

    words = ''
    if (.not. is_bearing(scene%general%analysis) .or. scene%model%foil /= foil_shell .or. &
        .not. is_symmetric(scene%operation, scene%sweep)) return
    beams = scene
    beams%model%foil = foil_beam
    beams%solver%stability = .false.
    call run%prepare(beams, quiet, error)
    if (.not. allocated(error)) call run%solve(beams, quiet, error)
    if (allocated(error)) return
    place = 0
    if (run%converged) place = place_of(study%name, run%found)
    if (place > 0) then
      off = abs(run%found(place)%number - study%value(1))/max(abs(study%value(1)), tiny(1.0_wp))
      words = 'off by '//text(100.0_wp*off, 2)//' % on the first mesh'
      if (off > study%target) then
        words = 'beams, '//words//', more than the target; '
      else if (off < 0.5_wp*study%target) then
        words = 'beams, though '//words//', less than half the target: foil = ''beam'' would do; '
      else
        words = 'beams, '//words//', not clearly less than the target; '
      end if
      call log%line('compared: '//words(:len(words) - 2))
    end if
    call run%discard()
  end subroutine compare_beams

  !> What came out, and what was left out.
  subroutine conclude(log, study, stopped, left_out)
    type(run_log_type), intent(in) :: log
    type(accuracy_study_type), intent(in) :: study
    character(len=*), intent(in) :: stopped  !! why there are no more meshes
    character(len=*), intent(in) :: left_out !! by the model

    call log%line(study%value_words())
    if (study%met()) then
      call log%line('target of '//text(100.0_wp*study%target, 4)//' % met; left out: '//left_out// &
                    'finer meshes, which the target does not need')
    else
      call log%gave_up('target of '//text(100.0_wp*study%target, 4)//' % not met: it needs '// &
                       study%needs())
      call log%line('left out: '//left_out//'finer meshes, because '//stopped)
    end if
  end subroutine conclude

  !> Place of a number in a list; 0: it is not there.
  pure function place_of(name, list) result(place)
    character(len=*), intent(in) :: name
    type(quantity_type), intent(in) :: list(:)
    integer :: place

    do place = size(list), 1, -1
      if (list(place)%name == name) return
    end do
  end function place_of

  !> CPU time of all ranks [s].
  function cpu_seconds() result(seconds)
    real(wp) :: seconds
    real(wp) :: all_ranks(1)

    call cpu_time(seconds)
    all_ranks = sum_over_ranks([seconds])
    seconds = all_ranks(1)
  end function cpu_seconds
end module gfb_accuracy_analysis
