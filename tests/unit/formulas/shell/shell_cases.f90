!> The benchmark problems of shell elements, each as displacement over its reference value.
!>
!> Definitions: [MacNealHarder1985], the skew plate after Morley. Lengths, forces and moduli have
!> the units of the sources.
module shell_cases
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: shell_section_type
  use shell_model, only: model_type, new_model, solve_model, clamp_node, hold_symmetry, &
    hold_unknown, add_area_load
  use shell_surfaces, only: bump_type, cylinder_type, sphere_type, twisted_type, ring_type, &
    plate_type
  implicit none (type, external)
  private
  public :: scordelis_lo, pinched_cylinder, hemisphere, twisted_beam, curved_beam, square_plate, &
            skew_plate, single_bump

  real(wp), parameter :: pi = acos(-1.0_wp)
  real(wp), parameter :: degree = pi/180.0_wp

contains

  !> Roof under its weight, a quarter of it: sag at the middle of the free edge.
  function scordelis_lo(mesh) result(ratio)
    integer, intent(in) :: mesh !! elements a side
    real(wp) :: ratio
    type(model_type) :: model
    integer :: i

    call new_model(cylinder_type(25.0_wp, 40.0_wp*degree, 25.0_wp), mesh, mesh, &
                   shell_section_type(0.25_wp, 4.32e8_wp, 0.0_wp, 0.0_wp), model)
    do i = 0, mesh
      call hold_unknown(model, model%node(i, 0), 1)
      call hold_unknown(model, model%node(i, 0), 3)
      call hold_symmetry(model, model%node(i, mesh), 2)
      call hold_symmetry(model, model%node(0, i), 1)
    end do
    call add_area_load(model, [0.0_wp, 0.0_wp, -90.0_wp])
    call solve_model(model)
    ratio = -model%displacement(3, model%node(mesh, mesh))/0.3024_wp
  end function scordelis_lo

  !> Cylinder with end diaphragms pinched at the middle, an eighth of it: displacement of the load.
  function pinched_cylinder(mesh) result(ratio)
    integer, intent(in) :: mesh !! elements a side
    real(wp) :: ratio
    type(model_type) :: model
    integer :: i

    call new_model(cylinder_type(300.0_wp, 90.0_wp*degree, 300.0_wp), mesh, mesh, &
                   shell_section_type(3.0_wp, 3.0e6_wp, 0.3_wp, 0.0_wp), model)
    do i = 0, mesh
      call hold_unknown(model, model%node(i, 0), 1)
      call hold_unknown(model, model%node(i, 0), 3)
      call hold_symmetry(model, model%node(i, mesh), 2)
      call hold_symmetry(model, model%node(0, i), 1)
      call hold_symmetry(model, model%node(mesh, i), 3)
    end do
    model%load(3, model%node(0, mesh)) = -0.25_wp
    call solve_model(model)
    ratio = -model%displacement(3, model%node(0, mesh))/1.8248e-5_wp
  end function pinched_cylinder

  !> Hemisphere with a hole pulled and pushed at the equator, a quarter: displacement of a load.
  function hemisphere(mesh) result(ratio)
    integer, intent(in) :: mesh !! elements a side
    real(wp) :: ratio
    type(model_type) :: model
    integer :: i

    call new_model(sphere_type(10.0_wp, 72.0_wp*degree), mesh, mesh, &
                   shell_section_type(0.04_wp, 6.825e7_wp, 0.3_wp, 0.0_wp), model)
    do i = 0, mesh
      call hold_symmetry(model, model%node(0, i), 2)
      call hold_symmetry(model, model%node(mesh, i), 1)
    end do
    call hold_unknown(model, model%node(0, 0), 3)
    model%load(1, model%node(0, 0)) = 1.0_wp
    model%load(2, model%node(mesh, 0)) = -1.0_wp
    call solve_model(model)
    ratio = model%displacement(1, model%node(0, 0))/0.094_wp
  end function hemisphere

  !> Twisted cantilever under loads at its tip along its width and along its normal there.
  function twisted_beam(along, across, thickness, reference) result(ratio)
    integer, intent(in) :: along, across !! elements
    real(wp), intent(in) :: thickness
    real(wp), intent(in) :: reference(2) !! displacement per unit load, in plane, out of plane
    real(wp) :: ratio(2)
    type(model_type) :: model
    integer :: load

    do load = 1, 2
      call new_model(twisted_type(12.0_wp, 1.1_wp), across, along, &
                     shell_section_type(thickness, 29.0e6_wp, 0.22_wp, 0.0_wp), model)
      ratio(load) = cantilever(model, merge(3, 2, load == 1))/reference(load)
    end do
  end function twisted_beam

  !> Curved cantilever under loads at its tip along the radius and along its normal.
  function curved_beam(along, across, reference) result(ratio)
    integer, intent(in) :: along, across !! elements
    real(wp), intent(in) :: reference(2) !! displacement in plane, out of plane
    real(wp) :: ratio(2)
    type(model_type) :: model
    integer :: load

    do load = 1, 2
      call new_model(ring_type(4.12_wp, 4.32_wp), across, along, &
                     shell_section_type(0.1_wp, 1.0e7_wp, 0.25_wp, 0.0_wp), model)
      ratio(load) = cantilever(model, merge(2, 3, load == 1))/reference(load)
    end do
  end function curved_beam

  !> Displacement in the middle of the last row under a unit load spread over it; with one column
  !> that of the row's first node.
  function cantilever(model, direction) result(displacement)
    type(model_type), intent(inout) :: model
    integer, intent(in) :: direction !! of load and displacement
    real(wp) :: displacement
    real(wp) :: weight(0:model%columns)
    integer :: i

    weight = 1.0_wp/model%columns
    weight([0, model%columns]) = 0.5_wp/model%columns
    do i = 0, model%columns
      call clamp_node(model, model%node(i, 0))
    end do
    model%load(direction, model%node(:, model%rows)) = weight
    call solve_model(model)
    displacement = model%displacement(direction, model%node(model%columns/2, model%rows))
  end function cantilever

  !> Square plate on hard simple supports under uniform load, a quarter: deflection of the centre.
  function square_plate(mesh, thickness) result(ratio)
    integer, intent(in) :: mesh          !! elements a side of the whole plate
    real(wp), intent(in) :: thickness
    real(wp) :: ratio
    type(model_type) :: model
    type(shell_section_type) :: section
    integer :: i, n

    n = mesh/2
    section = shell_section_type(thickness, 1.0e7_wp, 0.3_wp, 0.0_wp)
    call new_model(plate_type(0.5_wp, 0.5_wp*pi), n, n, section, model)
    model%held(1:2, :) = .true.
    do i = 0, n
      call hold_symmetry(model, model%node(0, i), 1)
      call hold_symmetry(model, model%node(i, 0), 2)
      ! The director keeps its tilt along the edge.
      call hold_unknown(model, model%node(n, i), 3)
      call hold_axis(model, model%node(n, i), 1)
      call hold_unknown(model, model%node(i, n), 3)
      call hold_axis(model, model%node(i, n), 2)
    end do
    call add_area_load(model, [0.0_wp, 0.0_wp, 1.0_wp])
    call solve_model(model)
    ratio = model%displacement(3, model%node(0, 0))/mindlin_deflection(section)
  end function square_plate

  !> Holds the rotation of a node about a global axis that is one of its own.
  pure subroutine hold_axis(model, node, direction)
    type(model_type), intent(inout) :: model
    integer, intent(in) :: node
    integer, intent(in) :: direction !! global axis
    integer :: k

    do k = 1, 2
      if (abs(model%axis(direction, k, node)) > 0.5_wp) model%held(3 + k, node) = .true.
    end do
  end subroutine hold_axis

  !> Centre of a unit square Mindlin plate, hard simple supports, unit load: Navier's series for the
  !> Kirchhoff plate and for the shear (Marcus moment over shear stiffness), which add up exactly.
  pure function mindlin_deflection(section) result(deflection)
    type(shell_section_type), intent(in) :: section
    real(wp) :: deflection
    real(wp) :: bending, shear, term, rigidity, shear_stiffness
    integer, parameter :: last = 1001
    integer :: m, n

    bending = 0.0_wp
    shear = 0.0_wp
    do m = last, 1, -2
      do n = last, 1, -2
        term = merge(1.0_wp, -1.0_wp, modulo((m + n)/2, 2) == 1)/(real(m, wp)*n)
        bending = bending + term/real(m**2 + n**2, wp)**2
        shear = shear + term/(m**2 + n**2)
      end do
    end do
    rigidity = section%youngs_modulus*section%thickness**3/ &
      (12.0_wp*(1.0_wp - section%poissons_ratio**2))
    shear_stiffness = 5.0_wp/12.0_wp*section%youngs_modulus/(1.0_wp + section%poissons_ratio)* &
      section%thickness
    deflection = 16.0_wp/pi**6*bending/rigidity + 16.0_wp/pi**4*shear/shear_stiffness
  end function mindlin_deflection

  !> Skew plate of 30 degrees on soft simple supports under uniform load: deflection of the centre.
  function skew_plate(mesh, thickness) result(ratio)
    integer, intent(in) :: mesh         !! elements a side
    real(wp), intent(in) :: thickness
    real(wp) :: ratio
    type(model_type) :: model
    type(shell_section_type) :: section
    integer :: i

    section = shell_section_type(thickness, 1.0e5_wp, 0.3_wp, 0.0_wp)
    call new_model(plate_type(100.0_wp, 30.0_wp*degree), mesh, mesh, section, model)
    model%held(1:2, :) = .true.
    do i = 0, mesh
      call hold_unknown(model, model%node(0, i), 3)
      call hold_unknown(model, model%node(mesh, i), 3)
      call hold_unknown(model, model%node(i, 0), 3)
      call hold_unknown(model, model%node(i, mesh), 3)
    end do
    call add_area_load(model, [0.0_wp, 0.0_wp, 1.0_wp])
    call solve_model(model)
    ratio = model%displacement(3, model%node(mesh/2, mesh/2))*section%youngs_modulus*thickness**3/ &
      (12.0_wp*(1.0_wp - section%poissons_ratio**2)*0.000408_wp*100.0_wp**4)
  end function skew_plate

  !> One bump of [Gu2020] Table 1 Case 1 without flats, corner lines held in height and, if not free
  !> to slide, along the strip; mean deflection of the crest line under 1 N/mm [m].
  function single_bump(along, across, slides) result(deflection)
    integer, intent(in) :: along, across !! elements of the whole arc and width
    logical, intent(in) :: slides        !! one corner line is free along the strip
    real(wp) :: deflection
    type(model_type) :: model
    real(wp) :: weight(0:across/2)
    integer :: i

    associate (columns => across/2, rows => along/2)
      call new_model(bump_type(1.778e-3_wp, 0.508e-3_wp, 19.05e-3_wp), columns, rows, &
                     shell_section_type(0.102e-3_wp, 214.0e9_wp, 0.29_wp, 8440.0_wp), model)
      weight = 1.0_wp/columns
      weight([0, columns]) = 0.5_wp/columns
      do i = 0, columns
        ! Seen from the crest both corners slide when one does.
        call hold_symmetry(model, model%node(i, 0), 1)
        call hold_unknown(model, model%node(i, rows), 2)
        if (.not. slides) call hold_unknown(model, model%node(i, rows), 1)
      end do
      do i = 0, rows
        call hold_symmetry(model, model%node(0, i), 3)
      end do
      ! A half of 1 N/mm on 19.05 mm.
      model%load(2, model%node(:, 0)) = -0.5_wp*19.05_wp*weight
      call solve_model(model)
      deflection = -dot_product(weight, model%displacement(2, model%node(:, 0)))
    end associate
  end function single_bump
end module shell_cases
