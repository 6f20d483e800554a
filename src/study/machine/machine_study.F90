#include "gfb_petsc.h"
!> A machine: the case files of its bearings, and the equilibrium of all.
module gfb_machine_study
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, quantity_word
  use gfb_result_names, only: add_result
  use gfb_scene, only: scene_type
  use gfb_machine_case, only: machine_case_type
  use gfb_memory_check, only: check_memory
  use gfb_petsc_session, only: wall_time, sum_over_ranks
  use gfb_c_library, only: peak_memory
  use gfb_bearing_plan, only: plan_bearing
  use gfb_bearing_builder, only: check_meshes
  use gfb_bearing_solution, only: new_solution
  use gfb_motion_study, only: stop_heat
  use gfb_shaft, only: body_type
  use gfb_held_shaft, only: free_motions
  use gfb_machine, only: machine_type, build_machine, line_of_shaft
  use gfb_machine_path, only: machine_path_type
  use gfb_bearing_answer, only: bearing_answer_type
  use gfb_machine_parts, only: part_type, read_parts, load_parts, heat_parts, axial_words, describe_others, check_fit, first_motions
  use gfb_bearing_rows, only: add_machine_heat
  use gfb_shaft_results, only: add_shaft_results, add_bearing_places
  use gfb_machine_equilibrium, only: machine_bearing_type, machine_equilibrium_type, find_machine_equilibrium
  use gfb_machine_transient, only: machine_transient_type, part_archive
  use gfb_machine_orbits, only: map_of_machine
  use gfb_period_map, only: period_map_type
  use gfb_periodic, only: periodic_type
  use gfb_machine_linear, only: linear_bearing_type, linearise_bearing, drop_linear_bearing
  use gfb_machine_modes, only: not_counted
  use gfb_machine_motions, only: machine_motions_type, find_motions, check_waves, add_motions, growth_of
  use gfb_machine_results, only: add_body, add_shaft_line, add_bearing, history_row
  use gfb_machine_response, only: machine_response_type, find_machine_response
  use gfb_unbalance_results, only: unbalance_force, speed_rpm_of, show_response, add_responses
  use gfb_critical_speeds, only: responding_type, critical_speed_type, find_responses, find_critical_speeds, add_critical_speeds
  use gfb_root_bracket, only: root_bracket_type
  use gfb_signals, only: stop_agreed
  use gfb_operation_case, only: angular_speed
  use gfb_scene_vibration, only: vibration_of
  use gfb_continuation, only: path_report_type
  use gfb_reasons, only: reason_type, reason_no_equilibrium
  use gfb_case_file, only: case_array_type, history_row_type
  use gfb_grid_series, only: grid_series_type
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_outcome, only: add_outcome
  use gfb_run_context, only: run_context_type
  use gfb_study, only: study_type
  implicit none (type)
  private

  real(wp), parameter :: higher(*) = [1.0_wp, 1.5_wp, 2.5_wp] !! speeds of a start, over the first [1]
  real(wp), parameter :: shortest = 0.01_wp   !! step of the speed, over that to a point [1]
  integer, parameter :: most_trials = 30          !! of the search for an onset
  real(wp), parameter :: onset_tolerance = 1.0e-8_wp !! of its speed, and of growth over speed [1]

  !> The machine, and what was found of it. It stays where it is from `solve` to `discard`.
  type, extends(study_type), public :: machine_study_type
    private
    type(machine_type) :: machine
    type(part_type), allocatable :: part(:)
    type(machine_bearing_type), allocatable :: bearing(:) !! of the parts' solutions
    type(machine_equilibrium_type) :: answer
    type(machine_path_type) :: path !! of answers over the speed
    type(machine_motions_type), allocatable :: motions(:) !! small ones about each answer
    type(history_row_type), allocatable :: history(:)     !! of a sweep
    type(machine_transient_type), allocatable :: time !! its way, where that is asked for
    type(periodic_type), allocatable :: orbits         !! that close, where they are asked for
    real(wp), allocatable :: moving_force(:) !! on the machine over time: weight and loads [N], [N m]
    real(wp) :: onset = 0.0_wp !! speed from which on it whirls; 0: none was found [rpm]
    integer :: counted = not_counted !! modes, when they were counted last
    type(machine_response_type), allocatable :: responses(:) !! to unbalance
    type(critical_speed_type), allocatable :: critical(:)
    type(error_type), allocatable :: refused !! what is wrong with the files of the bearings
  contains
    procedure :: prepare => prepare_machine, check => check_machine, solve => solve_machine
    procedure :: write => write_machine, discard => discard_machine
  end type machine_study_type

  !> The machine as what answers unbalance at a speed.
  type, extends(responding_type) :: responding_machine_type
    class(machine_study_type), pointer :: study => null()
    type(scene_type), pointer :: scene => null()
    type(run_log_type) :: log
  contains
    procedure :: respond => respond_at
  end type responding_machine_type

contains

  !> The machine under a gravity.
  function machine_of(self, scene, gravity) result(machine)
    class(machine_study_type), intent(in) :: self !! its bearings are read
    type(scene_type), intent(in) :: scene !! what is asked for
    real(wp), intent(in) :: gravity(2) !! [m/s^2]
    type(machine_type) :: machine
    type(machine_case_type) :: asked
    real(wp), allocatable :: places(:)
    integer :: i

    asked = scene%machine
    asked%gravity = gravity
    places = scene%unbalance%position
    if (scene%transient%pulse_is_placed) places = [places, scene%transient%pulse_position]
    machine = build_machine(asked, places, [(self%part(i)%scene%bearing%row, i=1, size(self%part))])
  end function machine_of

  !> Reads the files of the bearings, and says what the machine is.
  subroutine prepare_machine(self, scene, log)
    class(machine_study_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp), allocatable :: later(:)
    type(body_type) :: body
    integer :: i

    call read_parts(scene, self%part, self%refused)
    if (allocated(self%refused)) return
    self%machine = machine_of(self, scene, scene%machine%gravity)
    if (scene%transient%present) then
      later = self%machine%force
      self%machine = machine_of(self, scene, scene%transient%start_gravity)
      call move_alloc(later, self%moving_force)
    end if
    self%machine%heat = heat_parts(scene, self%machine, self%part)
    body = self%machine%shaft%body()
    call log%line('shaft with discs: '//text(body%mass, 5)//' kg, centre of mass at '//text(body%centre*1.0e3_wp, 5)// &
                  ' mm, transverse inertia '//text(body%transverse_inertia, 4)//' kg m2, polar '// &
                  text(body%polar_inertia, 4)//' kg m2')
    call log%line('shaft: '//text(size(self%machine%shaft%section))//' elements, '//text(size(self%machine%force))// &
                  ' motions, of which '//text(size(self%machine%held))//' at journals')
    if (.not. any(abs(self%machine%force) > 0.0_wp)) call log%line('neither weight nor loads: journals stand in the middle of their sleeves')
    if (size(self%machine%journal) == 1) call log%warning('one bearing alone holds the shaft, by the tilts of its journal')
    if (scene%general%asked%takes('dynamics')) call check_waves(scene, self%machine, log)
    call describe_others(self%machine, log)
    call load_parts(scene, self%machine, self%part)
    do i = 1, size(self%part)
      associate (part => self%part(i))
        call log%line('bearing '//text(i)//' at '//text(self%machine%journal(i)%position*1.0e3_wp, 5)//' mm, '// &
                      trim(scene%machine%file(i))//':')
        if (part%scene%bearing%row%moves_across) then
          call log%line('load by levers ('//text(part%scene%operation%load(1), 5)//', '//text(part%scene%operation%load(2), 5)//') N')
        end if
        if (part%scene%bearing%row%moves_along) call log%line(axial_words(part%scene))
        call plan_bearing(part%scene, log, part%plan)
        self%memory = self%memory + part%plan%memory
      end associate
    end do
    call check_fit(scene, self%part, log, self%refused)
  end subroutine prepare_machine

  !> Checks, after `prepare`, whether the study can be done.
  !>
  !> Fails where a bearing's file is wrong, where a mesh cannot be, and where the machine that computes has too little memory.
  subroutine check_machine(self, scene, error)
    class(machine_study_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! that is asked for
    type(error_type), allocatable, intent(out) :: error !! what is lacking
    integer :: i

    if (allocated(self%refused)) then
      error = self%refused
      return
    end if
    call check_memory(scene, self%memory, error)
    do i = 1, size(self%part)
      if (.not. allocated(error)) call check_meshes(self%part(i)%scene, self%part(i)%plan, error)
    end do
  end subroutine check_machine

  !> Each bearing alone under its load by levers, then all released; from there to the further speeds of a sweep.
  !>
  !> Fails when a mesh cannot be cut.
  subroutine solve_machine(self, scene, context, error)
    class(machine_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! that is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    integer :: i, points

    allocate (self%bearing(size(self%part)), self%history(0))
    points = 1
    if (scene%sweep%present) points = size(scene%sweep%values)
    allocate (self%motions(points))
    call start_machine(self, context, error)
    if (allocated(error)) return
    do i = 1, merge(0, points, context%restart%continues)
      if (self%reason%is_given()) exit
      if (points > 1) call context%log%is_within('point '//text(i)//' of '//text(points), real(i - 1, wp)/real(points, wp))
      self%machine%speed = angular_speed(scene%machine%speed_rpm) ! it may have begun at a higher one
      if (scene%sweep%present) self%machine%speed = angular_speed(scene%sweep%values(i))
      call find_answer(self, scene, context%log, self%motions(i))
      if (self%reason%is_given()) exit
      if (scene%sweep%present) call record_point(self, scene, i, context%log)
      if (i > 1) call look_for_onset(self, scene, i, context%log)
    end do
    call context%log%is_within('')
    if (.not. self%reason%is_given()) call answer_unbalance(self, scene, context%log)
    if ((scene%transient%present .or. scene%periodic%present) .and. .not. self%reason%is_given()) then
      do i = 1, merge(0, size(self%part), context%restart%continues)
        call stop_heat(self%part(i)%solution)
      end do
    end if
    if (scene%transient%present .and. .not. self%reason%is_given()) then
      self%machine%force = self%moving_force
      allocate (self%time)
      call self%time%run(scene, self%part, self%machine, self%answer, self%bearing, context, self%reason, error)
      if (allocated(error)) return
    end if
    if (scene%periodic%present .and. .not. self%reason%is_given()) call find_orbits(self, scene, context)
    call count_work(self)
    self%converged = .not. self%reason%is_given()
    if (.not. self%converged) call context%log%tell(self%reason%words())
  end subroutine solve_machine

  !> Orbits of the machine that close, from its equilibrium on.
  subroutine find_orbits(self, scene, context)
    class(machine_study_type), target, intent(inout) :: self
    type(scene_type), intent(in) :: scene !! with `&periodic`
    type(run_context_type), intent(in) :: context !! of the run
    class(period_map_type), allocatable :: map
    real(wp) :: bounds(2)

    call map_of_machine(scene, self%part, self%machine, self%answer, self%bearing, map, bounds)
    allocate (self%orbits)
    call self%orbits%run(scene%periodic, context, map, bounds, self%reason)
  end subroutine find_orbits

  !> An equilibrium to begin with: at the first speed, or, where levers lead to none there, at a higher one, from which the speed
  !> then falls. The reason is that of the first speed.
  !>
  !> Fails when a mesh cannot be cut.
  subroutine start_machine(self, context, error)
    class(machine_study_type), target, intent(inout) :: self
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(reason_type) :: first
    real(wp) :: speed_rpm
    integer :: i

    speed_rpm = self%part(1)%scene%operation%speed_rpm
    do i = 1, size(higher)
      self%machine%speed = angular_speed(higher(i)*speed_rpm)
      call start_bearings(self, higher(i)*speed_rpm, context, error)
      if (allocated(error) .or. context%restart%continues) return
      if (.not. self%reason%is_given()) then
        self%answer%motion = first_motions(self%machine, self%part)
        call find_balance(self, context%log)
      end if
      if (.not. self%reason%is_given()) return
      if (i == 1) first = self%reason
      if (stop_agreed() .or. .not. speed_rpm > 0.0_wp .or. self%machine%heat%present) exit ! a faster shaft is hotter
      if (i == size(higher)) exit
      call context%log%line('no equilibrium at '//text(higher(i)*speed_rpm, 6)//' rpm: '//self%reason%detail)
      call context%log%line('from a higher speed:')
      self%reason = reason_type()
    end do
    self%reason = first
  end subroutine start_machine

  !> Each bearing alone, with its journal under its load by levers.
  !>
  !> Fails when a mesh cannot be cut.
  subroutine start_bearings(self, speed_rpm, context, error)
    class(machine_study_type), target, intent(inout) :: self
    real(wp), intent(in) :: speed_rpm !! [rpm]
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(path_report_type) :: report
    integer :: i

    do i = 1, size(self%part)
      associate (part => self%part(i))
        if (allocated(part%solution)) then
          call part%solution%destroy()
          deallocate (part%solution)
        end if
        part%scene%operation%speed_rpm = speed_rpm
        call new_solution(part%solution)
        if (.not. context%restart%continues) call context%log%line('bearing '//text(i)//' alone:')
        if (context%restart%continues) part%scene%transient%present = .true. ! heat is frozen
        call part%solution%set_up(part%scene, part%plan, context)
        if (context%restart%continues) then
          call part%solution%resume(error, part_archive(i))
          if (allocated(error)) return
          self%bearing(i) = machine_bearing_type(part%solution%bearing, part%solution%newton, part%solution%path)
          cycle
        end if
        call part%solution%start(0, report, error)
        if (allocated(error)) return
        if (.not. report%converged()) then
          call part%solution%explain(report, .false., self%reason)
          self%reason%detail = 'bearing '//text(i)//' alone under its load by levers: '//report%reason()
          return
        end if
        self%bearing(i) = machine_bearing_type(part%solution%bearing, part%solution%newton, part%solution%path)
      end associate
    end do
  end subroutine start_bearings

  !> The equilibrium at the machine's present speed, from the last one, and small motions about it where they are asked for.
  subroutine find_answer(self, scene, log, motions)
    class(machine_study_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene !! of the machine
    type(run_log_type), intent(in) :: log
    type(machine_motions_type), intent(inout) :: motions

    call find_balance(self, log)
    if (self%answer%converged .and. scene%general%asked%takes('dynamics')) call find_linear(self, scene, log, motions)
  end subroutine find_answer

  !> The equilibrium at the machine's present speed, by smaller steps of the speed where it is not reached at once.
  subroutine find_balance(self, log)
    class(machine_study_type), intent(inout) :: self
    type(run_log_type), intent(in) :: log
    real(wp) :: speed, from, share

    speed = self%machine%speed
    if (self%answer%converged .and. allocated(self%path%speed)) then
      if (abs(self%path%speed(1) - speed) <= 0.0_wp) return
    end if
    call try_speed(self, speed, log)
    share = 0.5_wp
    do while (.not. self%answer%converged .and. allocated(self%path%speed) .and. share >= shortest)
      if (stop_agreed()) exit
      from = self%path%speed(1)
      call try_speed(self, from + share*(speed - from), log)
      if (.not. self%answer%converged) share = 0.5_wp*share
      if (self%answer%converged .and. share < 1.0_wp) then
        share = min(1.0_wp, 2.0_wp*share)
        self%answer%converged = .false.
      end if
    end do
    self%machine%speed = speed
    if (self%answer%converged) return
    self%reason%code = reason_no_equilibrium
    self%reason%detail = self%answer%reason
    if (stop_agreed()) call self%reason%stopped()
  end subroutine find_balance

  !> The equilibrium at a speed, with the journals where the last ones lead, else from where they stand.
  subroutine try_speed(self, speed, log)
    class(machine_study_type), intent(inout) :: self
    real(wp), intent(in) :: speed !! [rad/s]
    type(run_log_type), intent(in) :: log
    type(machine_equilibrium_type) :: nearby
    real(wp), allocatable :: from(:)

    self%machine%speed = speed
    from = self%answer%motion
    nearby = self%answer
    self%answer%converged = .false.
    if (allocated(self%path%speed)) then
      from = self%path%motion(:, 1)
      call find_machine_equilibrium(self%machine, self%bearing, self%path%at(speed), log, self%answer, nearby)
    end if
    if (.not. self%answer%converged) call find_machine_equilibrium(self%machine, self%bearing, from, log, self%answer)
    if (self%answer%converged) call self%path%add(speed, self%answer%motion)
  end subroutine try_speed

  !> The responses to unbalance, at speeds of their own or those of the points, and the critical speeds between them. The machine is
  !> back where it was behind it.
  subroutine answer_unbalance(self, scene, log)
    class(machine_study_type), target, intent(inout) :: self
    type(scene_type), target, intent(in) :: scene !! of the machine
    type(run_log_type), intent(in) :: log
    type(responding_machine_type) :: machine
    real(wp) :: speed
    integer :: i

    if (.not. scene%general%asked%takes('dynamics') .or. size(scene%unbalance%position) == 0) return
    machine%study => self
    machine%scene => scene
    machine%log = log
    speed = self%machine%speed
    allocate (self%responses(0))
    if (size(scene%dynamics%response_speeds) > 0) then
      call find_responses(machine, scene%dynamics%response_speeds, speed/angular_speed(1.0_wp), log, self%responses)
    else
      do i = 1, size(self%motions)
        if (allocated(self%motions(i)%response)) self%responses = [self%responses, self%motions(i)%response]
      end do
    end if
    call find_critical_speeds(machine, self%machine, self%responses, log, self%critical)
    self%reason = reason_type()
    if (abs(self%path%speed(1) - speed) <= 0.0_wp) return
    self%machine%speed = speed
    call find_balance(self, log)
  end subroutine answer_unbalance

  !> The response at a speed.
  subroutine respond_at(self, speed_rpm, response, found)
    class(responding_machine_type), intent(inout) :: self !! the machine
    real(wp), intent(in) :: speed_rpm !! [rpm]
    type(machine_response_type), intent(out) :: response !! where it was found
    logical, intent(out) :: found !! there is an equilibrium, and it could be linearised
    type(linear_bearing_type), allocatable :: linear(:)

    associate (study => self%study)
      study%machine%speed = angular_speed(speed_rpm)
      call find_balance(study, self%log)
      found = study%answer%converged
      if (.not. found) return
      call linearise(study, self%log, linear)
      call find_machine_response(study%machine, linear, unbalance_force(study%machine, self%scene), response, found)
      call drop_linear(study, linear)
    end associate
  end subroutine respond_at

  !> A row of the history, and a line of the log.
  subroutine record_point(self, scene, point, log)
    class(machine_study_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene !! of the machine
    integer, intent(in) :: point !! of its sweep
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: words

    self%history = [self%history, history_row(scene%sweep%values(point), self%machine, self%bearing, self%motions(point))]
    words = 'point '//text(point)//' of '//text(size(scene%sweep%values))//': '//text(scene%sweep%values(point))//' rpm'
    if (allocated(self%motions(point)%mode)) words = words//', growth '//text(growth_of(self%motions(point)), 4)//' 1/s'
    call log%line(words)
  end subroutine record_point

  !> Between two speeds at which the growth has different signs: the speed at which the least damped mode neither grows nor dies
  !> out, by false position. The last answer is found again behind it.
  subroutine look_for_onset(self, scene, point, log)
    class(machine_study_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene !! of the machine
    integer, intent(in) :: point !! of the sweep, the second one at least
    type(run_log_type), intent(in) :: log
    type(machine_motions_type) :: motions
    type(root_bracket_type) :: bracket
    real(wp) :: growth(2), trial, last
    integer :: i

    if (self%onset > 0.0_wp .or. .not. allocated(self%motions(point)%mode)) return
    growth = [growth_of(self%motions(point - 1)), growth_of(self%motions(point))]
    if (.not. growth(1)*growth(2) < 0.0_wp) return
    bracket = root_bracket_type(scene%sweep%values(point - 1), scene%sweep%values(point), growth(1), growth(2))
    do i = 1, most_trials
      call log%is_within('onset of whirl, trial '//text(i))
      last = bracket%high
      trial = bracket%trial()
      self%machine%speed = angular_speed(trial)
      call find_answer(self, scene, log, motions)
      if (self%reason%is_given()) exit
      call bracket%narrow(trial, growth_of(motions))
      if (abs(trial - last) <= onset_tolerance*trial .or. abs(bracket%at_high) <= onset_tolerance*self%machine%speed) then
        self%onset = trial
        exit
      end if
    end do
    if (self%onset > 0.0_wp) call log%line('onset: the least damped mode changes its sign of growth at '//text(self%onset, 8)//' rpm')
    if (.not. self%onset > 0.0_wp) call log%line('onset: between '//text(min(bracket%low, bracket%high))//' and '// &
                                                 text(max(bracket%low, bracket%high))//' rpm')
    self%reason = reason_type()
    call log%is_within('back at point '//text(point))
    self%machine%speed = angular_speed(scene%sweep%values(point))
    call find_answer(self, scene, log, motions)
  end subroutine look_for_onset

  !> What all bearings have cost.
  subroutine count_work(self)
    class(machine_study_type), intent(inout) :: self
    integer :: i

    do i = 1, size(self%part)
      if (.not. allocated(self%part(i)%solution)) cycle ! one before it had no answer
      associate (newton => self%part(i)%solution%newton)
        self%unknowns = self%unknowns + self%part(i)%solution%bearing%unknowns
        self%iterations = self%iterations + newton%iterations
        self%factorizations = self%factorizations + newton%factorizations
        self%factorizations_finest = self%factorizations_finest + newton%factorizations - newton%factorizations_before
      end associate
    end do
  end subroutine count_work

  !> Small motions about the equilibrium.
  subroutine find_linear(self, scene, log, motions)
    class(machine_study_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene !! of the machine
    type(run_log_type), intent(in) :: log
    type(machine_motions_type), intent(inout) :: motions
    type(linear_bearing_type), allocatable :: linear(:)

    call linearise(self, log, linear)
    call find_motions(scene, self%machine, linear, log, self%counted, motions)
    call drop_linear(self, linear)
  end subroutine find_linear

  !> All bearings about their answers.
  subroutine linearise(self, log, linear)
    class(machine_study_type), intent(inout) :: self
    type(run_log_type), intent(in) :: log
    type(linear_bearing_type), allocatable, intent(out) :: linear(:)
    integer :: i

    allocate (linear(size(self%bearing)))
    do i = 1, size(linear)
      call linearise_bearing(self%bearing(i)%bearing, vibration_of(self%part(i)%scene), log, linear(i))
    end do
  end subroutine linearise

  !> Frees them, and counts what they have cost.
  subroutine drop_linear(self, linear)
    class(machine_study_type), intent(inout) :: self
    type(linear_bearing_type), intent(inout) :: linear(:)
    integer :: i

    do i = 1, size(linear)
      self%factorizations = self%factorizations + linear(i)%response%factorizations
      call drop_linear_bearing(linear(i))
    end do
  end subroutine drop_linear

  !> Writes the results.
  !>
  !> Fails when a file cannot be written.
  subroutine write_machine(self, scene, context, summary, error)
    class(machine_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! that is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(case_array_type), allocatable :: arrays(:)
    type(result_grid_type), allocatable :: grids(:)
    type(bearing_answer_type), allocatable :: answer(:)
    type(grid_series_type), pointer :: series ! none where nothing moves
    real(wp) :: memory(1)
    integer :: i

    call context%log%heading('answer')
    call add_result(summary, 'analysis', trim(scene%general%asked%word))
    call add_result(summary, 'converged', self%converged)
    allocate (arrays(0), grids(0), answer(size(self%part)))
    nullify (series)
    call add_body(self%machine, summary)
    if (self%converged) call add_shaft(self, scene, arrays, grids)
    if (self%converged) call add_motions(self%machine, self%motions, scene%sweep%present, context%log, summary, arrays)
    if (self%converged .and. allocated(self%responses)) then
      if (size(self%responses) > 0) then
        associate (last => self%responses(size(self%responses)))
          if (size(self%responses) > 1) call context%log%line('unbalance        at '//text(speed_rpm_of(last), 6)//' rpm:')
          call show_response(self%machine, last, context%log)
        end associate
        call add_responses(self%machine, self%responses, scene%sweep%present .or. size(scene%dynamics%response_speeds) > 0, arrays)
        call add_critical_speeds(self%critical, self%responses, context%log, summary, arrays)
      end if
    end if
    do i = 1, size(self%part)
      if (.not. allocated(self%part(i)%solution)) cycle
      call add_bearing(i, self%machine%journal(i), self%part(i)%solution%bearing, scene%output, context%log, answer(i), summary, grids)
    end do
    call add_result(summary, 'power_loss', sum(answer%power_loss))
    ! Over time temperatures stay as they are, and films' heat is not solved for.
    if (self%converged .and. .not. (allocated(self%time) .or. allocated(self%orbits))) then
      call add_machine_heat(self%machine, self%answer, answer, context%log, summary, arrays)
    end if
    if (self%onset > 0.0_wp) call add_result(summary, 'onset_speed_rpm', self%onset)
    if (allocated(self%time)) then
      series => self%time%series
      summary = [summary, self%time%results()]
      call self%time%history%add_arrays(arrays)
    end if
    if (allocated(self%orbits)) then
      summary = [summary, self%orbits%results()]
      call self%orbits%add_arrays(arrays)
    end if
    call add_result(summary, 'unknowns', self%unknowns)
    call add_result(summary, 'newton_iterations', self%iterations)
    call add_result(summary, 'factorizations', self%factorizations)
    call add_result(summary, 'factorizations_finest', self%factorizations_finest)
    call add_result(summary, 'wall_time', wall_time() - context%start_time)
    memory = sum_over_ranks([peak_memory()])
    call add_result(summary, 'peak_memory', memory(1))
    call add_outcome(summary, self%converged, self%reason)
    call write_result_set(scene, context%folder, self%converged, context%origin(), summary, self%history, arrays, grids, &
                          context%csv, context%log, error, series=series, parts=files_of(self%part))
  end subroutine write_machine

  !> The case files of the bearings, so that a result has all that it is of.
  function files_of(part) result(file)
    type(part_type), intent(in) :: part(:)
    type(quantity_type), allocatable :: file(:)
    integer :: i

    allocate (file(size(part)))
    do i = 1, size(part)
      file(i)%name = 'bearing_'//text(i)
      file(i)%meaning = 'the case file of the bearing as it was read'
      file(i)%kind = quantity_word
      file(i)%word = part(i)%scene%verbatim
    end do
  end function files_of

  !> What is along the shaft, and around it: in its equilibrium, or where the time has led.
  subroutine add_shaft(self, scene, arrays, grids)
    class(machine_study_type), intent(in) :: self
    type(scene_type), intent(in) :: scene !! of the machine
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    type(result_grid_type), allocatable, intent(inout) :: grids(:)
    real(wp), allocatable :: line(:)
    integer :: i

    if (allocated(self%time)) then
      line = line_of_shaft(self%machine, self%time%march%motion(:, 1))
    else
      line = line_of_shaft(self%machine, free_motions(self%answer%held, self%answer%motion))
    end if
    call add_shaft_line(self%machine, line, arrays)
    call add_shaft_results(scene%machine, self%machine, line, arrays, grids)
    call add_bearing_places(self%machine%journal%position, [(self%part(i)%scene%bearing%length, i=1, size(self%part))], &
                            [(self%part(i)%scene%bearing%radius, i=1, size(self%part))], &
                            [(self%part(i)%scene%bearing%clearance, i=1, size(self%part))], &
                            [(self%part(i)%scene%capacity%smallest_gap, i=1, size(self%part))], arrays)
  end subroutine add_shaft

  !> Frees what the solvers hold.
  subroutine discard_machine(self)
    class(machine_study_type), intent(inout) :: self !! the study
    integer :: i

    if (.not. allocated(self%part)) return
    do i = 1, size(self%part)
      if (allocated(self%part(i)%solution)) call self%part(i)%solution%destroy()
    end do
  end subroutine discard_machine
end module gfb_machine_study
