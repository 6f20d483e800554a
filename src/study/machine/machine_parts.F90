#include "gfb_petsc.h"
!> The bearings of a machine: their case files under the machine's speed and loads, how they fit on the shaft, and what each does
!> alone, from which the whole begins.
module gfb_machine_parts
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail
  use gfb_text, only: text
  use gfb_units, only: micrometres
  use gfb_run_log, only: run_log_type
  use gfb_motion_cases, only: motion_free, follow_nothing
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: read_scene
  use gfb_analysis_row, only: analysis_equilibrium, analysis_fixed_position
  use gfb_heated_film, only: wall_given
  use gfb_shaft_heat, only: shaft_heat_type, build_shaft_heat
  use gfb_model_case, only: half_width_no, half_width_yes
  use gfb_mesh_case, only: linear_solver_direct, linear_solver_auto
  use gfb_foil_plan, only: choose_solution
  use gfb_film_surface, only: axial_coordinate
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_held_shaft, only: held_shaft_type, free_motions
  use gfb_machine, only: machine_type, hold_at_rest, bearing_loads, across_at_journals
  use gfb_bearing_solution, only: bearing_solution_type
  implicit none (type)
  private
  public :: read_parts, load_parts, heat_parts, axial_words, describe_others, check_fit, first_motions

  real(wp), parameter :: unlike = 0.01_wp    !! diameters that differ by more do not fit [1]
  real(wp), parameter :: rounding = 1.0e-9_wp !! of a length [1]
  real(wp), parameter :: touches = 1.0e-3_wp !! of a bearing's width: less of a segment is not under it [1]

  !> A bearing of the machine.
  type, public :: part_type
    type(scene_type), allocatable :: scene !! of its own file, under the machine's speed and load
    type(bearing_plan_type) :: plan
    type(bearing_solution_type), allocatable :: solution
  end type part_type

contains

  !> Reads the files of the bearings.
  !>
  !> Fails where one is wrong, or is of something that cannot be a bearing of a machine.
  subroutine read_parts(scene, part, error)
    type(scene_type), intent(in) :: scene !! of the machine
    type(part_type), allocatable, intent(out) :: part(:)
    type(error_type), allocatable, intent(out) :: error
    integer :: i

    allocate (part(size(scene%machine%file)))
    do i = 1, size(part)
      call read_part(scene, i, part(i), error)
      if (allocated(error)) return
    end do
    call check_axial(scene, part, error)
  end subroutine read_parts

  !> Reads the file of a bearing; speed, load and tilt are the machine's.
  !>
  !> Fails where the file is wrong, or is of something that cannot be a bearing of a machine.
  subroutine read_part(scene, number, part, error)
    type(scene_type), intent(in) :: scene !! of the machine
    integer, intent(in) :: number !! of the bearing
    type(part_type), intent(inout) :: part
    type(error_type), allocatable, intent(out) :: error
    character(len=:), allocatable :: file, why

    associate (machine => scene%machine)
      file = trim(machine%file(number))
      if (file(:1) /= '/') file = scene%file(:index(scene%file, '/', back=.true.))//file
      allocate (part%scene)
      call read_scene(file, part%scene, error)
      if (allocated(error)) return
      why = why_no_part(scene, number, part%scene)
      if (why /= '') then
        call fail(error, scene%file//': &bearings: files('//text(number)//') = '''//trim(machine%file(number))//''': '//why)
        return
      end if
      associate (one => part%scene)
        one%general%asked = analysis_equilibrium
        one%general%analysis = analysis_equilibrium
        one%dynamics%present = .false.
        one%capacity%limit = 0
        one%transient%present = .false.
        one%periodic%present = .false.
        one%operation%speed_rpm = machine%speed_rpm
        if (scene%sweep%present) one%operation%speed_rpm = scene%sweep%values(1)
        one%operation%tilt = 0.0_wp
        one%operation%moment = 0.0_wp
        one%operation%moment_given = machine%journal_tilts .and. one%bearing%row%has_sectors
        if (machine%journal_tilts) one%model%half_width = half_width_no
        ! Its coefficients are those of vibrations, which factors find faster.
        if (one%solver%linear_solver == linear_solver_auto) one%solver%linear_solver = linear_solver_direct
      end associate
      call choose_solution(part%scene)
    end associate
  end subroutine read_part

  !> Why a case cannot be a bearing of a machine; empty where it can.
  function why_no_part(scene, number, one) result(why)
    type(scene_type), intent(in) :: scene !! of the machine
    integer, intent(in) :: number !! of the bearing
    type(scene_type), intent(in) :: one !! of the bearing
    character(len=:), allocatable :: why

    why = ''
    associate (machine => scene%machine, row => one%bearing%row)
      if (allocated(one%machine)) then
        why = 'it is a machine itself'
      else if (.not. one%general%asked%has_film) then
        why = 'it is a case of foils alone'
      else if (row%moves_across .and. row%moves_along) then
        why = 'a machine has journal and thrust bearings, and no cones so far'
      else if (one%sweep%present) then
        why = 'it has a &sweep: the machine is at one point'
      else if (size(machine%shaft_conductivity) > 0 .and. one%thermal%present .and. one%thermal%shaft /= wall_given) then
        why = 'the shaft of the machine conducts (shaft_conductivity in &machine), so the bearing has no shaft of its own: '// &
              "in &thermal say shaft = 'given' with a shaft_temperature, at which it begins"
      else if (row%moves_along .and. .not. machine%axial_load_given) then
        why = 'a thrust bearing needs axial_load in &machine'
      else if (row%moves_along .and. any(machine%support_stiffness(:, number) > 0.0_wp)) then
        why = 'the support of a thrust bearing is rigid: support_stiffness must be 0 there'
      else if (one%model%half_width == half_width_yes .and. machine%journal_tilts) then
        why = "half_width = 'yes' in &model cannot tilt: leave it out, or say journal_tilts = .false. in &machine"
      else if (scene%periodic%present .and. one%model%foil%has_bumps .and. one%contact%may_rub .and. &
               (scene%periodic%motion == motion_free .or. scene%periodic%parameter /= follow_nothing)) then
        why = "contacts rub: with motion = 'free' or a parameter in &periodic friction_top and friction_sleeve must be 0"
      end if
    end associate
  end function why_no_part

  !> Says where loads and bearings along and across the axis do not go together.
  subroutine check_axial(scene, part, error)
    type(scene_type), intent(in) :: scene !! of the machine
    type(part_type), intent(in) :: part(:)
    type(error_type), allocatable, intent(out) :: error
    logical :: along(size(part))
    real(wp) :: play
    integer :: i

    along = [(part(i)%scene%bearing%row%moves_along, i=1, size(part))]
    associate (machine => scene%machine)
      if (size(machine%shaft_conductivity) > 0 .and. .not. any([(part(i)%scene%thermal%present, i=1, size(part))])) then
        call fail(error, scene%file//': &machine: shaft_conductivity: no bearing has &thermal')
      else if (all(along)) then
        call fail(error, scene%file//': &bearings: files: no journal bearing holds the shaft across its axis')
      else if (count(.not. along) == 1 .and. .not. machine%journal_tilts) then
        call fail(error, scene%file//': &bearings: files: one journal bearing holds no shaft without journal_tilts: name two')
      else if (machine%axial_load_given .and. .not. any(along)) then
        call fail(error, scene%file//': &machine: axial_load: no thrust bearing of &bearings carries it')
      else if (any(along) .and. .not. face_each_other(machine%facing, along)) then
        do i = 1, size(part)
          if (.not. along(i) .or. part(i)%scene%bearing%play > 0.0_wp .or. machine%facing(i)*machine%axial_load > 0.0_wp) cycle
          call fail(error, scene%file//': &machine: axial_load = '//text(machine%axial_load)//': it must press the runner on '// &
                    'the pads of bearing '//text(i)//', which face '//trim(merge('+z', '-z', machine%facing(i) > 0.0_wp)))
          return
        end do
      else if (any(along)) then
        play = play_between(machine%facing, machine%axial_offset, along)
        if (play > 0.0_wp) return
        call fail(error, scene%file//': &bearings: offset_z: leaves '//text(play)//' m in all for the gaps of thrust bearings '// &
                  'that face each other')
      end if
    end associate
  end subroutine check_axial

  !> Whether thrust bearings hold the runner from both sides.
  pure logical function face_each_other(facing, along)
    real(wp), intent(in) :: facing(:) !! of all bearings [1]
    logical, intent(in) :: along(:)   !! those of thrust
    face_each_other = any(along .and. facing > 0.0_wp) .and. any(along .and. facing < 0.0_wp)
  end function face_each_other

  !> Sum of the smallest gaps on both sides of the runner [m].
  pure real(wp) function play_between(facing, offset, along) result(play)
    real(wp), intent(in) :: facing(:) !! of all bearings [1]
    real(wp), intent(in) :: offset(:) !! along z [m]
    logical, intent(in) :: along(:)   !! those of thrust
    play = minval(offset, along .and. facing < 0.0_wp) - maxval(offset, along .and. facing > 0.0_wp)
  end function play_between

  !> Gives each bearing the load, or the gap, with which it begins alone.
  subroutine load_parts(scene, machine, part)
    type(scene_type), intent(in) :: scene !! of the machine
    type(machine_type), intent(in) :: machine
    type(part_type), intent(inout) :: part(:)
    real(wp), allocatable :: load(:, :)
    real(wp) :: middle
    logical :: regular, along(size(part))
    integer :: i

    call bearing_loads(machine, load, regular)
    along = [(part(i)%scene%bearing%row%moves_along, i=1, size(part))]
    associate (asked => scene%machine)
      do i = 1, size(part)
        associate (one => part(i)%scene)
          one%operation%load = load(:, i)
          if (.not. along(i)) cycle
          if (.not. face_each_other(asked%facing, along)) then
            one%operation%axial_load = asked%facing(i)*asked%axial_load/count(along)
            cycle
          end if
          middle = maxval(asked%axial_offset, along .and. asked%facing > 0.0_wp) + &
                   0.5_wp*play_between(asked%facing, asked%axial_offset, along)
          one%general%asked = analysis_fixed_position
          one%general%analysis = analysis_fixed_position
          one%operation%moment_given = .false.
          one%operation%tilt_is_sought = asked%journal_tilts
          one%operation%axial_gap = asked%facing(i)*(middle - asked%axial_offset(i))
        end associate
      end do
    end associate
  end subroutine load_parts

  !> Says what else moves than the shaft across its axis, and how the shaft conducts heat.
  subroutine describe_others(machine, log)
    type(machine_type), intent(in) :: machine
    type(run_log_type), intent(in) :: log

    if (machine%along > 0) call log%line('along z the shaft is rigid, with a force of '//text(machine%force(machine%along), 5)//' N')
    if (size(machine%sleeve) > 0) call log%line('sleeves on supports that give way: '//text(size(machine%sleeve)))
    if (.not. machine%heat%present) return
    associate (heat => machine%heat)
      call log%line('the shaft conducts; to places beyond its ends '//text(heat%end_conductance(1), 3)//' and '// &
                    text(heat%end_conductance(2), 3)//' W/K, through its surface '//text(sum(heat%lost), 3)//' W/K, from discs '// &
                    text(sum(heat%disc_conductance), 3)//' W/K')
    end associate
  end subroutine describe_others

  !> How a thrust bearing begins alone.
  pure function axial_words(scene) result(words)
    type(scene_type), intent(in) :: scene !! of the bearing
    character(len=:), allocatable :: words

    if (scene%general%analysis%floats) then
      words = 'axial load '//text(scene%operation%axial_load, 5)//' N'
    else
      words = 'begins with a gap of '//text(scene%operation%axial_gap*micrometres, 4)//' um, in the middle of the play'
    end if
  end function axial_words

  !> The heat of the shaft between the bearings that have some.
  pure function heat_parts(scene, machine, part) result(heat)
    type(scene_type), intent(in) :: scene !! of the machine
    type(machine_type), intent(in) :: machine
    type(part_type), intent(in) :: part(:)
    type(shaft_heat_type) :: heat
    integer :: i

    heat = build_shaft_heat(scene%machine, machine%shaft, [(part(i)%scene%thermal%present, i=1, size(part))], &
                            [(length_of(part(i)), i=1, size(part))])
  end function heat_parts

  !> Warns of a shaft that is not as thick as a bearing has it.
  !>
  !> Fails where two bearings overlap.
  subroutine check_fit(scene, part, log, error)
    type(scene_type), intent(in) :: scene !! of the machine
    type(part_type), intent(in) :: part(:) !! its bearings
    type(run_log_type), intent(in) :: log
    type(error_type), allocatable, intent(out) :: error
    real(wp) :: whole
    integer :: i, k

    associate (machine => scene%machine)
      whole = sum(machine%length)
      do i = 1, size(part)
        if (machine%bearing_position(i) - 0.5_wp*length_of(part(i)) < -rounding*whole .or. &
            machine%bearing_position(i) + 0.5_wp*length_of(part(i)) > whole*(1.0_wp + rounding)) then
          call fail(error, scene%file//': &bearings: positions('//text(i)//') = '//text(machine%bearing_position(i))// &
                    ': the bearing, '//text(length_of(part(i)))//' m long, reaches beyond an end of the shaft')
          return
        end if
        do k = 1, i - 1
          if (abs(machine%bearing_position(i) - machine%bearing_position(k)) >= &
              0.5_wp*(length_of(part(i)) + length_of(part(k))) - rounding*whole) cycle
          call fail(error, scene%file//': &bearings: positions('//text(i)//') = '//text(machine%bearing_position(i))// &
                    ': the bearing overlaps that of positions('//text(k)//')')
          return
        end do
        if (part(i)%scene%bearing%row%moves_across) call check_diameter(scene, i, part(i), log)
      end do
    end associate
  end subroutine check_fit

  !> Length of a bearing along the axis [m].
  pure real(wp) function length_of(part) result(length)
    type(part_type), intent(in) :: part
    length = merge(0.0_wp, part%scene%bearing%length, part%scene%bearing%row%has_sectors)
  end function length_of

  !> Warns of segments under a journal bearing with another diameter.
  subroutine check_diameter(scene, number, part, log)
    type(scene_type), intent(in) :: scene !! of the machine
    integer, intent(in) :: number !! of the bearing
    type(part_type), intent(in) :: part
    type(run_log_type), intent(in) :: log
    real(wp) :: first, last
    integer :: k

    associate (machine => scene%machine, bearing => part%scene%bearing)
      first = 0.0_wp
      do k = 1, size(machine%length)
        last = first + machine%length(k)
        if (min(last, machine%bearing_position(number) + 0.5_wp*bearing%length) - &
            max(first, machine%bearing_position(number) - 0.5_wp*bearing%length) > touches*bearing%length .and. &
            abs(machine%outer_diameter(k) - 2.0_wp*bearing%radius) > unlike*2.0_wp*bearing%radius) then
          call log%warning('segment '//text(k)//' of the shaft, under bearing '//text(number)//', has a diameter of '// &
                           text(machine%outer_diameter(k))//' m, the journal in the bearing''s file one of '// &
                           text(2.0_wp*bearing%radius)//' m')
        end if
        first = last
      end do
    end associate
  end subroutine check_diameter

  !> The journals where their bearings carry the loads by levers, tilted as the shaft bends between them under its weight; a thrust
  !> bearing's runner as it stands in its film alone.
  function first_motions(machine, part) result(motion)
    type(machine_type), intent(in) :: machine
    type(part_type), intent(in) :: part(:) !! each solved alone
    real(wp), allocatable :: motion(:) !! [m], [rad]
    type(held_shaft_type) :: held
    real(wp), allocatable :: line(:)
    logical :: regular
    integer :: i

    allocate (motion(size(machine%held)), source=0.0_wp)
    call hold_at_rest(machine, across_at_journals(machine), held, regular)
    if (regular) then
      do i = 1, size(part)
        call put_alone(machine, i, part(i), motion)
      end do
      line = free_motions(held, [(motion(findloc(machine%held, held%held(i), 1)), i=1, size(held%held))])
      motion = line(machine%held)
    end if
    do i = 1, size(part)
      if (regular .and. all(machine%journal(i)%coordinate /= axial_coordinate)) cycle
      call put_alone(machine, i, part(i), motion)
    end do
  end function first_motions

  !> Motions of a journal where its bearing alone is.
  subroutine put_alone(machine, number, part, motion)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the bearing
    type(part_type), intent(in) :: part
    real(wp), intent(inout) :: motion(:) !! a [m], [rad]

    associate (journal => machine%journal(number), place => part%solution%bearing%shaft_place())
      motion(journal%at) = journal%sign*(journal%sleeve(journal%coordinate) - place(journal%coordinate))
    end associate
  end subroutine put_alone
end module gfb_machine_parts
