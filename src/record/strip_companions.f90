!> What formulas say of a strip beside its answer: single bumps and planar chains.
module gfb_strip_companions
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_foil_cases, only: bump_foil_case_type, fixed_edge_none, fixed_edge_trailing, &
                            has_sizes, one_bump, one_strip, solid_width, strips_differ
  use gfb_strip_load_case, only: crest_forces, load_plates, bump_stiffness
  use gfb_bump_chain, only: bump_chain_type, bump_chain_solution_type, solve_bump_chain
  use gfb_curved_bump, only: curved_bump_stiffness
  use gfb_case_file, only: case_array_type, add_array
  implicit none (type, external)
  private
  public :: strip_companions, show_companions, add_companions

  integer, parameter :: longest_chain = 60 !! bumps; longer ones can take seconds

  !> Deflections at the full load, [m].
  type, public :: companions_type
    real(wp), allocatable :: walowit_anno(:) !! (bumps), single bumps without friction
    real(wp), allocatable :: curved_bump(:)  !! (bumps), exact single bumps, feet rub on the sleeve
    real(wp), allocatable :: chain(:)        !! (bumps), planar chain; empty where there is none
    logical :: chain_lifts = .false.         !! it holds corners down that would lift
  end type companions_type

contains

  !> Computes them for the forces on the crests; a plate's force is shared evenly, as single bumps
  !> do.
  function strip_companions(scene, force) result(companions)
    type(scene_type), intent(in) :: scene !! what is asked for
    real(wp), intent(in) :: force !! on all crests at the full load [N]
    type(companions_type) :: companions
    type(bump_foil_case_type), allocatable :: one(:)
    real(wp) :: crest_force(scene%bump_foil%bumps), soft(scene%bump_foil%bumps), &
                exact(scene%bump_foil%bumps) !! forces, stiffnesses by two formulas [N], [N/m]
    integer :: bump, strip

    associate (foil => scene%bump_foil)
      if (scene%strip_load%kind == load_plates) then
        crest_force = force/foil%bumps
      else
        crest_force = crest_forces(scene%strip_load, foil)
      end if
      soft = 0.0_wp
      exact = 0.0_wp
      do strip = 1, merge(foil%strips, 1, strips_differ(foil)) ! side by side, under one plate
        one = one_bump(foil, [(bump, bump=1, foil%bumps)])
        if (strips_differ(foil)) one = one_bump(one_strip(foil, strip), &
                                                [(bump, bump=1, foil%bumps)])
        soft = soft + bump_stiffness(one)*one%pitch%value*solid_width(one)
        exact = exact + curved_bump_stiffness(one%youngs_modulus, one%poissons_ratio, &
                                              one%thickness%value, one%half_length%value, &
                                              one%height%value, solid_width(one), &
                                              scene%contact%friction_sleeve)
      end do
    end associate
    companions%walowit_anno = crest_force/soft
    companions%curved_bump = crest_force/exact
    call solve_chain(scene, crest_force, companions)
  end function strip_companions

  !> The planar chain, where it models the strip: crests with given forces, a bump at the fixed
  !> edge.
  subroutine solve_chain(scene, crest_force, companions)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: crest_force(:) !! [N]
    type(companions_type), intent(inout) :: companions
    type(bump_chain_type) :: chain
    type(bump_chain_solution_type) :: solution
    logical :: mirrored

    allocate (companions%chain(0))
    associate (foil => scene%bump_foil, contact => scene%contact)
      if (foil%bumps > longest_chain .or. scene%strip_load%kind == load_plates) return
      if (has_sizes(foil) .or. strips_differ(foil)) return ! its bumps are alike
      if (foil%fixed_edge /= fixed_edge_none .and. foil%fixed_line /= fixed_line_corner) return
      mirrored = foil%fixed_edge == fixed_edge_trailing
      chain = bump_chain_type(foil%half_length%value, foil%height%value, foil%thickness%value, &
                              foil%youngs_modulus, foil%poissons_ratio, foil%pitch%value, &
                              solid_width(foil), foil%bumps, foil%fixed_edge /= fixed_edge_none, &
                              contact%friction_top, contact%friction_sleeve)
    end associate
    if (mirrored) then
      call solve_bump_chain(chain, crest_force(size(crest_force):1:-1), solution)
      solution%crest_deflection = solution%crest_deflection(size(crest_force):1:-1)
    else
      call solve_bump_chain(chain, crest_force, solution)
    end if
    if (.not. solution%converged) return
    companions%chain = solution%crest_deflection
    companions%chain_lifts = solution%lifted
  end subroutine solve_chain

  !> A table of the crests: shells, chain, single bumps.
  subroutine show_companions(log, deflection, companions)
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp), intent(in) :: deflection(:) !! of the shells' crests [m]
    type(companions_type), intent(in) :: companions !! deflections by formulas
    character(len=80) :: line
    integer :: bump

    call log%line('deflection [um]   shells   planar chain   curved bump   Walowit-Anno')
    do bump = 1, size(deflection)
      if (size(companions%chain) > 0) then
        write (line, '(a, i4, 4x, f12.4, f15.4, f14.4, f15.4)') 'crest', bump, &
          micrometres*[deflection(bump), companions%chain(bump), companions%curved_bump(bump), &
                       companions%walowit_anno(bump)]
      else
        write (line, '(a, i4, 4x, f12.4, a15, f14.4, f15.4)') 'crest', bump, &
          micrometres*deflection(bump), '-', &
          micrometres*[companions%curved_bump(bump), companions%walowit_anno(bump)]
      end if
      call log%line(trim(line))
    end do
    if (companions%chain_lifts) then
      call log%line('the planar chain holds down corners that would lift')
    end if
  end subroutine show_companions

  !> The same for the result file.
  subroutine add_companions(companions, arrays)
    type(companions_type), intent(in) :: companions !! deflections by formulas
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the file

    call add('walowit_anno', 'deflection of single bumps without friction', companions%walowit_anno)
    call add('curved_bump', 'deflection of exact single bumps, feet rubbing', &
             companions%curved_bump)
    if (size(companions%chain) > 0) then
      call add('planar_chain', 'deflection of a planar chain of bumps', companions%chain)
    end if

  contains

    !> One number a bump.
    subroutine add(name, meaning, values)
      character(len=*), intent(in) :: name, meaning
      real(wp), intent(in) :: values(:) !! [m]
      call add_array(arrays, '/companions/'//name, 'm', meaning, reshape(values, [size(values), 1]))
    end subroutine add
  end subroutine add_companions
end module gfb_strip_companions
