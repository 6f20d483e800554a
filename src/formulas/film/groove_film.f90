!> Element of a film one of whose surfaces has narrow grooves: their limit of infinitely many.
!>
!> A cell of the pattern has a ridge, gap h, and a groove, gap h + d, of the share g. The pressure
!> is even in it, and so are the flow across the lines of the pattern, along n, and the slope along
!> them, along t:
!>
!> $$ \langle f \rangle = (1 - g) f(h) + g f(h + d), \quad
!>    K_n = 1/\langle 1/G \rangle, \quad K_t = \langle G \rangle,
!>    \quad H_n = \langle h/G \rangle/\langle 1/G \rangle, \quad H_t = \langle h \rangle $$
!>
!> with \( G = h^3 (1 + 6 \lambda/h) \). In gfb's frame the flow of the gas is \( q/r =
!> -K \nabla p/(12 \mu) + U S \) with the density r of `gfb_gas_law`, half the shaft's speed U
!> along x, and the shear vector \( S = H e_x \) where the grooves stand still,
!> \( S = (2 \langle h \rangle I - H) e_x \) where they turn with the shaft. Grooves on the shaft
!> add nothing that changes in time: the pressure is steady in this frame.
!>
!> Near the end of a band the jump of `gfb_groove_ends` is spread over a narrow strip, where it adds
!> to the slope along z.
!>
!> Source: [VohrChow1965], derived anew with the frame of the grooves, where \( w = \pm U e_x \).
module gfb_groove_film
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_geometry_type, film_shapes
  use gfb_film_flow, only: film_flow_type
  use gfb_gas_law, only: gas_law_type, gas_state_type, gas_state
  use gfb_groove_ends, only: fitted, end_open, end_jump
  implicit none (type, external)
  private
  public :: groove_residual, groove_jacobian, groove_friction, groove_friction_rates, mean_depth, &
            groove_jump

  !> The end of a band, in the strip on which the jump of the pressure there is spread.
  type, public :: groove_end_type
    integer :: band = 0           !! its number; 0: there is no end
    real(wp) :: spread = 0.0_wp   !! pitch over the width of the strip [1]
    real(wp) :: side = 1.0_wp     !! 1: the band lies behind its end, -1: before it, along z or r
    real(wp) :: sense = 1.0_wp    !! 1: the motion pumps as in the fit, -1: against it
    integer :: outside = end_open !! of the end
    real(wp) :: pitch = 0.0_wp    !! [m]
    real(wp) :: fit(fitted, 2) = 0.0_wp !! see `gfb_groove_ends`; 0: not weighed
  end type groove_end_type

  !> The grooves of an element. Without a share there are none.
  type, public :: groove_type
    real(wp) :: share = 0.0_wp      !! g, of the groove in the pattern [1]
    real(wp) :: depth = 0.0_wp      !! d [m]
    real(wp) :: along(2) = [1.0_wp, 0.0_wp] !! t, along the lines (x, z) [1]
    logical :: turns = .false.      !! they are on the shaft
    type(groove_end_type) :: end    !! of their band, where it lies in the element
  end type groove_type

  ! A number that follows pressure and gap is a list: itself, its derivatives by p and by h.
  integer, parameter :: value = 1, by_p = 2, by_h = 3
  real(wp), parameter :: one(3) = [1.0_wp, 0.0_wp, 0.0_wp]

  !> A Gauss point.
  type :: place_type
    real(wp) :: pressure = 0.0_wp, gap = 0.0_wp !! p [Pa], h of the ridges [m]
    real(wp) :: slope(2) = 0.0_wp !! of the pressure [Pa/m]
    real(wp) :: speed = 0.0_wp    !! U [m/s]
  end type place_type

  !> What a pattern makes of the film at a point.
  type :: pattern_type
    real(wp) :: mobility(3, 3) = 0.0_wp !! (list, xx xz zz) of r K/(12 mu) [Pa m3/(Pa s)]
    real(wp) :: shear(3, 2) = 0.0_wp    !! (list, x z) of S [m]
    real(wp) :: gas(3) = 0.0_wp         !! r [Pa]
  end type pattern_type

contains

  !> Mean depth of the grooves: what they hold beyond the gap of the ridges [m].
  elemental real(wp) function mean_depth(groove) result(depth)
    type(groove_type), intent(in) :: groove !! of an element
    depth = groove%share*groove%depth
  end function mean_depth

  !> Residual of the film's equation on one element.
  !>
  !> $$ r_a = \int_{\Omega^e} \nabla N_a \cdot \Bigl( \frac{r}{12 \mu} K \nabla p - r U S \Bigr)
  !>    d\Omega $$
  pure subroutine groove_residual(geometry, flow, law, groove, pressure, gap, excess, residual)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(groove_type), intent(in) :: groove  !! of the element
    real(wp), intent(in) :: pressure(:)  !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)       !! of the ridges at the nodes [m]
    real(wp), intent(in) :: excess(:)    !! of the gap at the points over the nodes' [m]
    real(wp), intent(out) :: residual(:) !! one a node [Pa m3/s]
    real(wp) :: shapes(size(gap), size(gap)), flux(2)
    type(place_type) :: at
    type(pattern_type) :: here
    integer :: i

    shapes = film_shapes(size(gap))
    residual = 0.0_wp
    do i = 1, size(gap)
      associate (gradient => geometry%gradient(:, :, i))
        at = place_at(geometry, flow, shapes(:, i), i, pressure, gap, excess)
        here = pattern_at(law, groove, at)
        flux = flux_at(here, at)
        residual = residual + geometry%area(i)*(flux(1)*gradient(1, :) + flux(2)*gradient(2, :))
      end associate
    end do
  end subroutine groove_residual

  !> Exact derivatives of `groove_residual` by the nodal pressures and gaps, and by the excess.
  pure subroutine groove_jacobian(geometry, flow, law, groove, pressure, gap, excess, by_pressure, &
                                  by_gap, by_excess)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(groove_type), intent(in) :: groove  !! of the element
    real(wp), intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! of the ridges at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    real(wp), intent(out) :: by_pressure(:, :) !! (nodes, nodes) dr_a/dp_b [m3/s]
    real(wp), intent(out) :: by_gap(:, :)      !! (nodes, nodes) dr_a/dh_b [Pa m2/s]
    real(wp), intent(out) :: by_excess(:, :)   !! (nodes, points) [Pa m2/s]
    real(wp) :: shapes(size(gap), size(gap)), flux_p(2), flux_h(2)
    real(wp) :: moved(size(gap), 2), driven(size(gap))
    type(place_type) :: at
    type(pattern_type) :: here
    integer :: i, b

    shapes = film_shapes(size(gap))
    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    do i = 1, size(gap)
      associate (shape => shapes(:, i), gradient => geometry%gradient(:, :, i), &
                 area => geometry%area(i))
        at = place_at(geometry, flow, shape, i, pressure, gap, excess)
        here = pattern_at(law, groove, at)
        flux_p = flux_of(here%mobility(by_p, :), at%slope) &
          - at%speed*(here%gas(by_p)*here%shear(value, :) + here%gas(value)*here%shear(by_p, :))
        flux_h = flux_of(here%mobility(by_h, :), at%slope) &
          - at%speed*here%gas(value)*here%shear(by_h, :)
        associate (k => here%mobility(value, :))
          moved(:, 1) = area*(k(1)*gradient(1, :) + k(2)*gradient(2, :))
          moved(:, 2) = area*(k(2)*gradient(1, :) + k(3)*gradient(2, :))
        end associate
        driven = area*(flux_p(1)*gradient(1, :) + flux_p(2)*gradient(2, :))
        by_excess(:, i) = area*(flux_h(1)*gradient(1, :) + flux_h(2)*gradient(2, :))
        do b = 1, size(gap)
          by_pressure(:, b) = by_pressure(:, b) + gradient(1, b)*moved(:, 1) &
            + gradient(2, b)*moved(:, 2) + shape(b)*driven
          by_gap(:, b) = by_gap(:, b) + shape(b)*by_excess(:, i)
        end do
      end associate
    end do
  end subroutine groove_jacobian

  !> Drag of the film on the shaft.
  !>
  !> $$ D = \int \Bigl( 2 \mu U \Bigl\langle \frac{1}{h + 2 \lambda} \Bigr\rangle + \frac{1}{2} S
  !>    \cdot \nabla p
  !>      + 6 \mu U n_x^2 \Bigl( \langle h^2/G \rangle - H_n \langle h/G \rangle \Bigr) \Bigr)
  !>    \frac{r}{R} \, d\Omega $$
  !>
  !> It is the shear on the shaft and, where the grooves are on it, the pressure on their walls. The
  !> last term is the slope of the pressure from ridge to groove and back.
  pure real(wp) function groove_friction(geometry, flow, law, groove, pressure, gap, excess) &
    result(drag)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow !! speed of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(groove_type), intent(in) :: groove  !! of the element
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! of the ridges at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    real(wp) :: shapes(size(gap), size(gap)), drive(3)
    type(place_type) :: at
    type(pattern_type) :: here
    integer :: i

    shapes = film_shapes(size(gap))
    drag = 0.0_wp
    do i = 1, size(gap)
      at = place_at(geometry, flow, shapes(:, i), i, pressure, gap, excess)
      here = pattern_at(law, without_end(groove), at)
      drive = drag_at(law, groove, at)
      drag = drag + geometry%area(i)*geometry%stretch(i)* &
             (2.0_wp*at%speed*drive(value) + 0.5_wp*dot_product(here%shear(value, :), at%slope))
    end do
  end function groove_friction

  !> Derivatives of that drag.
  pure subroutine groove_friction_rates(geometry, flow, law, groove, pressure, gap, excess, &
                                        by_pressure, by_gap)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow !! speed of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(groove_type), intent(in) :: groove  !! of the element
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! of the ridges at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    real(wp), intent(out) :: by_pressure(:), by_gap(:) !! one a node [N/Pa], [N/m]
    real(wp) :: shapes(size(gap), size(gap)), drive(3)
    type(place_type) :: at
    type(pattern_type) :: here
    integer :: i

    shapes = film_shapes(size(gap))
    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    do i = 1, size(gap)
      associate (shape => shapes(:, i), gradient => geometry%gradient(:, :, i), &
                 area => geometry%area(i)*geometry%stretch(i))
        at = place_at(geometry, flow, shape, i, pressure, gap, excess)
        here = pattern_at(law, without_end(groove), at)
        drive = drag_at(law, groove, at)
        by_pressure = by_pressure + area*(0.5_wp*matmul(here%shear(value, :), gradient) &
          + (2.0_wp*at%speed*drive(by_p) + 0.5_wp*dot_product(here%shear(by_p, :), at%slope))*shape)
        by_gap = by_gap + area*shape*(2.0_wp*at%speed*drive(by_h) &
                                      + 0.5_wp*dot_product(here%shear(by_h, :), at%slope))
      end associate
    end do
  end subroutine groove_friction_rates

  !> A band's grooves, where its end does not count: its jump has no part in the drag.
  pure type(groove_type) function without_end(groove) result(band)
    type(groove_type), intent(in) :: groove

    band = groove
    band%end = groove_end_type()
  end function without_end

  !> Pressure, gap, slope and speed at a Gauss point.
  pure type(place_type) function place_at(geometry, flow, shape, i, pressure, gap, excess) &
    result(at)
    type(film_geometry_type), intent(in) :: geometry
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: shape(:) !! functions there [1]
    integer, intent(in) :: i !! number of the point
    real(wp), intent(in) :: pressure(:), gap(:), excess(:) !! see `groove_residual`

    at%pressure = dot_product(shape, pressure)
    at%gap = dot_product(shape, gap) + excess(i)
    ! Less one node's pressure: an even pressure has no gradient to the last digit.
    at%slope = matmul(geometry%gradient(:, :, i), pressure - pressure(1))
    at%speed = geometry%stretch(i)*flow%entraining_speed
  end function place_at

  !> Flux of the equation's residual, against the flow of the gas [Pa m2/s].
  pure function flux_at(here, at) result(flux)
    type(pattern_type), intent(in) :: here
    type(place_type), intent(in) :: at
    real(wp) :: flux(2)
    flux = flux_of(here%mobility(value, :), at%slope) &
      - at%speed*here%gas(value)*here%shear(value, :)
  end function flux_at

  !> A symmetric tensor (xx, xz, zz) times a slope.
  pure function flux_of(tensor, slope) result(flux)
    real(wp), intent(in) :: tensor(3), slope(2)
    real(wp) :: flux(2)
    flux = [tensor(1)*slope(1) + tensor(2)*slope(2), tensor(2)*slope(1) + tensor(3)*slope(2)]
  end function flux_of

  !> What the pattern makes of the film at a pressure and a gap of its ridges.
  pure type(pattern_type) function pattern_at(law, groove, at) result(here)
    type(gas_law_type), intent(in) :: law
    type(groove_type), intent(in) :: groove
    type(place_type), intent(in) :: at
    type(gas_state_type) :: gas
    real(wp), dimension(3) :: fluid, conductance, across, lag, height
    real(wp) :: sine, cosine

    gas = gas_state(law, at%pressure)
    here%gas = [gas%r, gas%r_p, 0.0_wp]
    fluid(value) = gas%r/(12.0_wp*gas%mu)
    fluid(by_p:) = [(gas%r_p/12.0_wp - fluid(value)*gas%mu_p)/gas%mu, 0.0_wp]
    call weigh_pieces(law, groove, at%pressure, at%gap, across, conductance, lag, height)
    cosine = groove%along(1)
    sine = groove%along(2)
    here%mobility(:, 1) = times(fluid, across*sine**2 + conductance*cosine**2)
    here%mobility(:, 2) = times(fluid, conductance - across)*(sine*cosine)
    here%mobility(:, 3) = times(fluid, across*cosine**2 + conductance*sine**2)
    here%shear(:, 1) = lag*sine**2 + height*cosine**2
    here%shear(:, 2) = (height - lag)*(sine*cosine)
    if (groove%turns) then
      here%shear = -here%shear
      here%shear(:, 1) = here%shear(:, 1) + 2.0_wp*height
    end if
    if (groove%end%band > 0) then
      call add_end(groove, at%gap, across*cosine**2 + conductance*sine**2, here)
    end if
  end function pattern_at

  !> K_n, K_t, H_n, H_t of groove and ridge.
  pure subroutine weigh_pieces(law, groove, pressure, gap, across, conductance, lag, height)
    type(gas_law_type), intent(in) :: law
    type(groove_type), intent(in) :: groove
    real(wp), intent(in) :: pressure, gap !! p [Pa], h [m]
    real(wp), intent(out) :: across(3), conductance(3) !! [m3]
    real(wp), intent(out) :: lag(3), height(3)         !! [m]
    real(wp) :: way(3, 2), share(2), closed(2), h(2), resistance(3), dragged(3)
    integer :: i

    share = [1.0_wp - groove%share, groove%share]
    h = [gap, gap + groove%depth]
    resistance = 0.0_wp
    dragged = 0.0_wp
    do i = 1, 2
      way(:, i) = conductance_of(law, pressure, h(i))
      closed(i) = 1.0_wp/way(value, i)
      associate (of_open => share(i)*closed(i), part => share(i)*closed(i)**2)
        resistance = resistance + [of_open, -part*way(by_p, i), -part*way(by_h, i)]
        dragged = dragged + [of_open*h(i), -part*h(i)*way(by_p, i), &
                             of_open - part*h(i)*way(by_h, i)]
      end associate
    end do
    conductance = share(1)*way(:, 1) + share(2)*way(:, 2)
    height = [gap + mean_depth(groove), 0.0_wp, 1.0_wp]
    across(value) = 1.0_wp/resistance(value)
    across(by_p:) = -across(value)**2*resistance(by_p:)
    lag = times(dragged, across)
  end subroutine weigh_pieces

  !> What the shaft's motion alone brakes with, over 2 U [Pa s/m].
  pure function drag_at(law, groove, at) result(drag)
    type(gas_law_type), intent(in) :: law
    type(groove_type), intent(in) :: groove
    type(place_type), intent(in) :: at
    real(wp) :: drag(3)
    real(wp), dimension(3) :: h, entrained, dragged, squared, couette
    real(wp), dimension(3) :: across, conductance, lag, height
    type(gas_state_type) :: gas
    real(wp) :: share(2)
    integer :: i

    gas = gas_state(law, at%pressure)
    call weigh_pieces(law, groove, at%pressure, at%gap, across, conductance, lag, height)
    share = [1.0_wp - groove%share, groove%share]
    dragged = 0.0_wp
    squared = 0.0_wp
    couette = 0.0_wp
    do i = 1, 2
      h = [at%gap + merge(groove%depth, 0.0_wp, i == 2), 0.0_wp, 1.0_wp]
      entrained = over(h, conductance_of(law, at%pressure, h(value)))
      dragged = dragged + share(i)*entrained
      squared = squared + share(i)*times(h, entrained)
      couette = couette + share(i)*over(one, slipping(law, at%pressure, h(value)))
    end do
    drag = times([gas%mu, gas%mu_p, 0.0_wp], &
                 couette + 3.0_wp*groove%along(2)**2*(squared - times(lag, dragged)))
  end function drag_at

  !> Adds the jump at a band's end to the slope in its strip.
  !>
  !> There the band's own slope is \( p_z - \sigma J/w \) with the jump J, the strip's width w and
  !> the side \( \sigma \) of the band. J is linear in the flow across, so that \( q_z/r \) has the
  !> factor \( D = 1/(1 - c_2 K_{zz} l/(w h^3)) \), and a shear of its own.
  pure subroutine add_end(groove, gap, open, here)
    type(groove_type), intent(in) :: groove
    real(wp), intent(in) :: gap     !! h [m]
    real(wp), intent(in) :: open(3) !! K_zz [m3]
    type(pattern_type), intent(inout) :: here !! of the band
    real(wp) :: numbers(2), by_gap(2), factor(3), share(3), before(3), turned(3), own(3)

    associate (end => groove%end)
      call end_jump(end%fit, end%outside, groove%depth, gap, numbers, by_gap)
      factor = end%spread*[numbers(2)/gap**3, 0.0_wp, by_gap(2)/gap**3 - 3.0_wp*numbers(2)/gap**4]
      own = end%side*end%sense*end%spread* &
            [numbers(1)/gap**2, 0.0_wp, by_gap(1)/gap**2 - 2.0_wp*numbers(1)/gap**3]
    end associate
    factor = over(one, one - times(factor, open))
    before = here%shear(:, 2)
    here%shear(:, 2) = times(factor, before + times(own, open))
    share = over(here%mobility(:, 2), here%mobility(:, 3)) ! K_xz over K_zz
    here%shear(:, 1) = here%shear(:, 1) + times(share, here%shear(:, 2) - before)
    turned = times(factor - one, here%mobility(:, 2))
    here%mobility(:, 1) = here%mobility(:, 1) + times(share, turned)
    here%mobility(:, 2) = here%mobility(:, 2) + turned
    here%mobility(:, 3) = times(factor, here%mobility(:, 3))
  end subroutine add_end

  !> The jump of the pressure at a band's end, into the band, times the area of an element of its
  !> strip [N].
  pure real(wp) function groove_jump(geometry, flow, law, groove, pressure, gap, excess) &
    result(jump)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow !! speed of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(groove_type), intent(in) :: groove  !! of the element
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! of the ridges at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    real(wp) :: shapes(size(gap), size(gap)), flux(2), numbers(2), by_gap(2)
    type(place_type) :: at
    type(gas_state_type) :: gas
    integer :: i

    shapes = film_shapes(size(gap))
    jump = 0.0_wp
    associate (end => groove%end)
      do i = 1, size(gap)
        at = place_at(geometry, flow, shapes(:, i), i, pressure, gap, excess)
        flux = -flux_at(pattern_at(law, groove, at), at)
        gas = gas_state(law, at%pressure)
        call end_jump(end%fit, end%outside, groove%depth, at%gap, numbers, by_gap)
        jump = jump + geometry%area(i)*end%pitch*12.0_wp*gas%mu/at%gap**2* &
               (end%sense*numbers(1)*at%speed + numbers(2)*end%side*flux(2)/(gas%r*at%gap))
      end do
    end associate
  end function groove_jump

  !> G, what is open to a flow of pressure [m3].
  pure function conductance_of(law, pressure, gap) result(open)
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: pressure, gap
    real(wp) :: open(3), slip

    slip = 6.0_wp*law%mean_free_path*law%ambient_pressure
    open = [gap**3 + slip*gap**2/pressure, -slip*(gap/pressure)**2, &
            3.0_wp*gap**2 + 2.0_wp*slip*gap/pressure]
  end function conductance_of

  !> The gap, as wide as it is to a flow of shear [m].
  pure function slipping(law, pressure, gap) result(wide)
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: pressure, gap
    real(wp) :: wide(3), slip

    slip = 2.0_wp*law%mean_free_path*law%ambient_pressure/pressure
    wide = [gap + slip, -slip/pressure, 1.0_wp]
  end function slipping

  !> Product of two numbers that follow pressure and gap.
  pure function times(first, second) result(product)
    real(wp), intent(in) :: first(3), second(3)
    real(wp) :: product(3)

    product(value) = first(value)*second(value)
    product(by_p:) = first(by_p:)*second(value) + first(value)*second(by_p:)
  end function times

  !> Their quotient.
  pure function over(first, second) result(quotient)
    real(wp), intent(in) :: first(3), second(3)
    real(wp) :: quotient(3)

    quotient(value) = first(value)/second(value)
    quotient(by_p:) = (first(by_p:) - quotient(value)*second(by_p:))/second(value)
  end function over
end module gfb_groove_film
