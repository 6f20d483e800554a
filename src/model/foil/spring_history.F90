!> Dampers and Maxwell arms beside the springs of an elastic foundation, over time.
!>
!> A spring's deflection is that of the unknown that moves it: a station's own under the axial mean, a node's
!> pressure else. What dampers remember stands at these unknowns, too. A step gives the springs a drag and a pull:
!>
!> $$ K h_f + c (a_0 h_f + s_h) + c_a (a_0 h_f + s_q) = p - p_a, $$
!>
!> with s from earlier values of deflections and of the arms' dashpots, and \( c_a \) of `gfb_maxwell_arm`.
module gfb_spring_history
  use gfb_kinds, only: wp
  use gfb_maxwell_arm, only: maxwell_arm_type, arm_viscosity, arm_relaxed
  use gfb_foil_model, only: foil_model_type
  implicit none (type, external)
  private
  public :: begin_springs, damp_springs, follow_springs, recall_springs, put_deflections

  !> What damped springs of a pad remember, at its unknowns: now and one step ago.
  type, public :: spring_history_type
    logical :: local = .false.                !! a node's pressure moves the foil there: deflections are no unknowns
    logical :: recalled = .false.             !! pull and drag are those of a restart file
    real(wp), allocatable :: deflection(:, :) !! (unknowns, 2) [m]
    real(wp), allocatable :: relaxed(:, :)    !! (unknowns, 2) ways of the arms' dashpots [m]
    real(wp), allocatable :: pull(:, :)       !! (unknowns, 2) of the step that led there [Pa]
    real(wp) :: drag(2) = 0.0_wp              !! the same [N/m3]
    real(wp), allocatable :: next_pull(:)     !! of the step that is tried [Pa]
    real(wp), allocatable :: past_rate(:)     !! what earlier ways of dashpots add to their rates in it [m/s]
    real(wp) :: next_drag = 0.0_wp            !! of that step [N/m3]
    real(wp) :: factor = 0.0_wp               !! its a_0 [1/s]
  end type spring_history_type

  !> Dampers and arms beside the springs of all pads; none where they are not begun.
  type, public :: foil_dampers_type
    real(wp) :: damping = 0.0_wp !! c, viscous [N s/m3]
    type(maxwell_arm_type) :: arm
    type(spring_history_type), allocatable :: springs(:) !! (pads)
  contains
    procedure :: pads
  end type foil_dampers_type

contains

  !> Pads whose springs have dampers.
  pure integer function pads(self)
    class(foil_dampers_type), intent(in) :: self !! of a bearing
    pads = 0
    if (allocated(self%springs)) pads = size(self%springs)
  end function pads

  !> Begins at rest, with relaxed arms.
  subroutine begin_springs(unknown, foil, history)
    real(wp), intent(in) :: unknown(:) !! of the pad [SI]
    class(foil_model_type), intent(in) :: foil !! the springs
    type(spring_history_type), intent(out) :: history !! of them

    history%local = foil%has_local_springs()
    allocate (history%pull(size(unknown), 2), source=0.0_wp)
    history%deflection = spread(spring_deflection(foil, unknown), 2, 2)
    history%relaxed = history%deflection
  end subroutine begin_springs

  !> Drag and pull of a step become the springs'.
  subroutine damp_springs(damping, arm, weight, foil, history)
    real(wp), intent(in) :: damping !! c, viscous [N s/m3]
    type(maxwell_arm_type), intent(in) :: arm !! beside the springs
    real(wp), intent(in) :: weight(0:) !! of the step's differences [1/s]
    class(foil_model_type), intent(inout) :: foil !! the springs
    type(spring_history_type), intent(inout) :: history !! of them
    real(wp) :: viscosity

    history%factor = weight(0)
    history%next_drag = damping*weight(0)
    history%next_pull = damping*(weight(1)*history%deflection(:, 1) + weight(2)*history%deflection(:, 2))
    if (arm%is_present()) then
      viscosity = arm_viscosity(arm, weight(0))
      history%past_rate = weight(1)*history%relaxed(:, 1) + weight(2)*history%relaxed(:, 2)
      history%next_drag = history%next_drag + viscosity*weight(0)
      history%next_pull = history%next_pull + viscosity*history%past_rate
    end if
    call foil%put_damping(history%next_drag, history%next_pull)
  end subroutine damp_springs

  !> The state that the step has led to becomes the newest one.
  subroutine follow_springs(arm, unknown, foil, history)
    type(maxwell_arm_type), intent(in) :: arm !! beside the springs
    real(wp), intent(in) :: unknown(:) !! of the pad [SI]
    class(foil_model_type), intent(in) :: foil !! the springs, with the step's drag and pull
    type(spring_history_type), intent(inout) :: history !! of them

    history%deflection(:, 2) = history%deflection(:, 1)
    history%deflection(:, 1) = spring_deflection(foil, unknown)
    history%pull(:, 2) = history%pull(:, 1)
    history%pull(:, 1) = history%next_pull
    history%drag = [history%next_drag, history%drag(1)]
    if (.not. arm%is_present()) return
    history%relaxed(:, 2) = history%relaxed(:, 1)
    history%relaxed(:, 1) = arm_relaxed(arm, history%factor, history%past_rate, history%deflection(:, 1))
  end subroutine follow_springs

  !> Puts the springs where a step has left them: where a pressure moves them, by its drag and pull.
  subroutine recall_springs(step, unknown, foil, history)
    integer, intent(in) :: step !! 1: the newest, 2: the one before
    real(wp), intent(in) :: unknown(:) !! of the pad then [SI]
    class(foil_model_type), intent(inout) :: foil !! the springs
    type(spring_history_type), intent(inout) :: history !! with all but deflections

    if (history%recalled) call foil%put_damping(history%drag(step), history%pull(:, step))
    history%deflection(:, step) = spring_deflection(foil, unknown)
  end subroutine recall_springs

  !> Makes deflections the past of local springs, which follow neither from pressures nor from unknowns: with the pull that
  !> holds each there, and without drag.
  subroutine put_deflections(deflection, unknown, foil, history)
    real(wp), intent(in) :: deflection(:, :) !! (unknowns, 2) now and one step ago [m]
    real(wp), intent(in) :: unknown(:, :)    !! of the pad then [SI]
    class(foil_model_type), intent(inout) :: foil !! the springs, without dampers after that
    type(spring_history_type), intent(inout) :: history !! that has begun; gets them when it is recalled
    integer :: step

    history%recalled = .true.
    history%drag = 0.0_wp
    history%pull = 0.0_wp
    call foil%put_damping(0.0_wp, history%pull(:, 1))
    do step = 1, 2
      history%pull(foil%source, step) = unknown(foil%source, step) - foil%origin - deflection(foil%source, step)/foil%rate
    end do
  end subroutine put_deflections

  !> Deflections at the unknowns that move the springs; 0 at others.
  pure function spring_deflection(foil, unknown) result(deflection)
    class(foil_model_type), intent(in) :: foil !! the springs
    real(wp), intent(in) :: unknown(:) !! of the pad [SI]
    real(wp) :: deflection(size(unknown)) !! [m]

    deflection = 0.0_wp
    deflection(foil%first + 1:) = unknown(foil%first + 1:) ! of stations without nodes on this rank, too
    deflection(foil%source) = foil%deflection(unknown)
  end function spring_deflection
end module gfb_spring_history
